/* `gbdpt`: gradient-domain bidirectional path tracing, see "Gradient-Domain Bidirectional Path Tracing", by M. Manzi, M. Kettunen,
   M. Aittala, J. Lehtinen, F. Durand and M. Zwicker. Samples are those of `bdpt`; each also tells how its pixel differs from the
   neighbours, by paths shifted into them. What the picture and its gradients say together is made one by the kernels of
   gbdpt/reconstruct.h. */
#define ENGINE_SPLATS
#define ENGINE_GRADIENTS
#include "bdpt/light_path.h"
#include "gbdpt/camera_path.h"
#include "gbdpt/show.h"

/* Shows a light path's vertices to the camera, and what they are shifted. */
ALWAYS_INLINE void show_all(const World* world, const Picture* picture, lanes_u half_of_samples, const LampStart* start, const Vertex* light,
                            const Sides* of_camera, Traced* traced COUNTED_PARAMETER) {
#pragma unroll 1
    for (uint i = 0u; i < LIGHT_SEGMENTS; ++i) {
        if (!lanes_any(light[i].joins)) continue;
        if (i == 0u) {
            COUNTED_LANES(light[i].joins, GBDPT_PREVIOUS_LAMP_WORK)
        } else {
            COUNTED_LANES(light[i].joins, GBDPT_PREVIOUS_WORK)
        }
        const Previous previous = i == 0u ? previous_on_lamp(world, start) : previous_vertex(&light[i - 1u]);
        const Vertex vertex = light[i];
        show_shifted(world, picture, half_of_samples, &vertex, &previous, of_camera, traced COUNTED_ARGUMENT);
    }
}

ALWAYS_INLINE lanes_mask trace_sample(const World* world, const Picture* picture, Path* path, lanes_mask alive, lanes_u place,
                                      Gradients* gradients, Traced* traced COUNTED_PARAMETER) {
    Vertex light[LIGHT_VERTICES];
    Path from_lamp = *path;
    from_lamp.random = random_split(&path->random);
    const lanes_mask lit = world->lamps.count > 0u ? alive : lanes_none();
    Odds odds;
    const lanes_u number = leave_lamp(world, &from_lamp, &odds, lit COUNTED_ARGUMENT);
    const LampStart start = {from_lamp.ray.origin, from_lamp.throughput, odds.earlier, number, from_lamp.inside};
    trace_light_path(world, &from_lamp, &odds, number, lit, light, traced COUNTED_ARGUMENT);
    const uint pixels = (uint)picture->width * (uint)picture->height;
    const lanes_u half_of_samples = lanes_select_u((lanes_u)(0u), (lanes_u)(pixels), place >= pixels);
    show_all(world, picture, half_of_samples, &start, light, &path->inside, traced COUNTED_ARGUMENT);
    return trace_from_camera(world, picture, path, alive, light, gradients, traced COUNTED_ARGUMENT);
}

#define INTEGRATOR gbdpt
#include "engine/sample.h"
#include "engine/kernels.h"
#include "gbdpt/reconstruct.h"
