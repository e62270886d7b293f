/* `gpt`: gradient-domain path tracing, see "Gradient-Domain Path Tracing", by M. Kettunen, M. Manzi, M. Aittala, J. Lehtinen,
   F. Durand and M. Zwicker. Samples are those of `pt_nee`; each also tells how its pixel differs from the neighbours, by paths
   shifted into them: those of `gbdpt`, without light paths. */
#define ENGINE_SPLATS
#define ENGINE_GRADIENTS
#define BDPT_ENDS 1
#include "gbdpt/camera_path.h"

ALWAYS_INLINE lanes_mask trace_sample(const World* world, const Picture* picture, Path* path, lanes_mask alive, lanes_u place,
                                      Gradients* gradients, Traced* traced COUNTED_PARAMETER) {
    (void)place;
    return trace_from_camera(world, picture, path, alive, 0, gradients, traced COUNTED_ARGUMENT);
}

#define INTEGRATOR gpt
#include "engine/sample.h"
#include "engine/kernels.h"
#include "gbdpt/reconstruct.h"
