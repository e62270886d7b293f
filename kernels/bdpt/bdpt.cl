/* `bdpt`: bidirectional path tracing, see "Bidirectional Path Tracing", by E. Lafortune and Y. Willems, and "Robust Monte Carlo
   Methods for Light Transport Simulation", by E. Veach. A sample is two paths, one from a lamp and one from the camera. Light
   comes into the picture by every strategy that makes a path of both: lamps met by the camera's path, lamps asked from it, vertices
   of both joined, and vertices of the light path that the camera sees. Each counts by its share. */
#define ENGINE_SPLATS
#include "bdpt/join.h"
#include "bdpt/light_path.h"

/* Shows a light path's vertices to the camera. Apart from the path, which would wait for it at every turn: 570 -> 1910
   Msamples/s (H200). */
ALWAYS_INLINE void show_all(const World* world, const Picture* picture, const Vertex* light, const Sides* of_camera,
                            Traced* traced COUNTED_PARAMETER) {
#pragma unroll 1
    for (uint i = 0u; i < LIGHT_SEGMENTS; ++i) {
        const Vertex vertex = light[i];
        show(world, picture, &vertex, of_camera, traced COUNTED_ARGUMENT);
    }
}

/* Traces a path from the camera and joins its vertices to the light path's; returns the lanes where it is of full length. */
ALWAYS_INLINE lanes_mask trace_from_camera(const World* world, const Picture* picture, Path* path, lanes_mask alive,
                                           const Vertex* light, Traced* traced COUNTED_PARAMETER) {
    Odds odds;
    odds.last = inverse_of_picture(picture, vec_dot(path->ray.direction, vec_of(picture->frame.axis_area)));
    odds.earlier = (lanes_f)(0.0f);
    COUNTED_LANES(alive, BDPT_CAMERA_WORK)
    lanes_mask full = lanes_none();
#pragma unroll 1
    for (uint segment = 1u; segment <= ENGINE_PATH_LENGTH; ++segment) {
        if (!lanes_any(alive)) continue;
        const Arrival met = meet(world, path COUNTED_ARGUMENT);
        COUNTED_SEGMENT(world->scene, alive)
        traced->segments += lanes_select_u((lanes_u)(0u), (lanes_u)(1u), alive);
        if (segment == ENGINE_PATH_LENGTH) full = alive;
        if (SHINE_AND_GO_ON || lanes_any(alive & met.ends)) {
            const lanes_f share =
                segment == 1u ? (lanes_f)(1.0f) : share_of_meeting(world, path, &met, &odds, alive COUNTED_ARGUMENT);
            gather_met(world, path, met.face, lanes_select((lanes_f)(0.0f), share, alive), alive COUNTED_ARGUMENT);
        }
        const lanes_f distance = hit_distance(&met.hit);
        const Vertex view =
            move_to_vertex(path, &met, &odds, odds.last * distance * distance, alive COUNTED_ARGUMENT);
        if (segment < ENGINE_PATH_LENGTH) ask(world, path, &view, traced COUNTED_ARGUMENT);
#pragma unroll 1
        for (uint i = 0u; segment + i + 1u < ENGINE_PATH_LENGTH; ++i)
            join(world, path, &view, &light[i], traced COUNTED_ARGUMENT);
        alive = bounce(world, path, &met, &odds, false, alive COUNTED_ARGUMENT);
    }
    return full;
}

ALWAYS_INLINE lanes_mask trace_sample(const World* world, const Picture* picture, Path* path, lanes_mask alive,
                                      Traced* traced COUNTED_PARAMETER) {
    Vertex light[LIGHT_VERTICES];
    Path from_lamp = *path;
    from_lamp.random = random_split(&path->random);
    const lanes_mask lit = world->lamps.count > 0u ? alive : lanes_none();
    Odds odds;
    const lanes_u number = leave_lamp(world, &from_lamp, &odds, lit COUNTED_ARGUMENT);
    trace_light_path(world, &from_lamp, &odds, number, lit, light, traced COUNTED_ARGUMENT);
    show_all(world, picture, light, &path->inside, traced COUNTED_ARGUMENT);
    return trace_from_camera(world, picture, path, alive, light, traced COUNTED_ARGUMENT);
}

#define INTEGRATOR bdpt
#include "engine/sample.h"
#include "engine/kernels.h"
