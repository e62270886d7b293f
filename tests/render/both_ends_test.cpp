// What formulas know of light that both ends of a path find: no reference image, and errors of a thousandth.
#include <cmath>
#include <functional>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "bench/validate/passes.h"
#include "tests/support/devices.h"
#include "tests/support/oracle_support.h"
#include "tests/support/planted.h"
#include "tests/support/render_once.h"
#include "tests/support/scenes.h"

namespace ptb {
namespace {

constexpr double room_radius = 10, room_albedo = 0.8, radiance = 5, ior = 1.5;

/// The camera in a matte ball, looking past a lamp in its middle: the wall looks the same everywhere.
Scene room_of_lamp(double lamp_radius) {
    Scene scene;
    scene.camera = {{-6, 1, 0}, {-10, 2, 1}, {0, 1, 0}, 80};
    add(scene, {0, 0, 0}, room_radius, matte(room_albedo));
    add(scene, {0, 0, 0}, lamp_radius, lamp({radiance, radiance, radiance}));
    return scene;
}

/// The share of what leaves a point of the wall, by cosine, that a ball of this radius in the middle takes.
double taken_by(double radius) { return radius * radius / (room_radius * room_radius); }

/// The lamp's light after one bounce, two and so on, until paths have their length.
double wall_radiance(double lamp_radius, int path_length) {
    double sum = 0, arriving = taken_by(lamp_radius) * radiance;
    for (int segments = 2; segments <= path_length; ++segments) {
        arriving *= room_albedo;
        sum += arriving;
        arriving *= 1 - taken_by(lamp_radius);
    }
    return sum;
}

/// The share of light that goes straight through a surface of glass, met from outside at this sine.
double passed(double sine) {
    const double cos = std::sqrt(1 - sine * sine), inside = std::sqrt(1 - sine * sine / (ior * ior));
    const double across = (cos - ior * inside) / (cos + ior * inside);
    const double along = (ior * cos - inside) / (ior * cos + inside);
    return 1 - (across * across + along * along) / 2;
}

/// The mean of that over a lamp in the middle of a glass ball, as it is seen: as large as `ior` times itself.
double passed_of_lamp(double lamp_radius, double glass_radius) {
    constexpr int rings = 10'000;
    double sum = 0;
    for (int i = 0; i < rings; ++i)
        sum += passed(ior * lamp_radius * std::sqrt((i + 0.5) / rings) / glass_radius) / rings;
    return sum;
}

/// The mean of the first channel over independent renders, and how sure it is.
struct Found {
    double mean = 0, standard_error = 0;

    /// In normal standard errors.
    double z(double expected) const {
        return student_z(mean - expected, 0, standard_error * standard_error, enough_passes - 1);
    }
};

using Renderer = std::function<Film(const RenderJob&)>;

Found found_by(const Renderer& render, RenderJob job) {
    double sum = 0, squares = 0;
    for (int i = 0; i < enough_passes; ++i) {
        ++job.seed;
        const Film film = render(job);
        double mean = 0;
        for (std::size_t j = 0; j < film.mean.rgb.size(); j += 3)
            mean += film.mean.rgb[j] / static_cast<double>(film.mean.size.pixels());
        sum += mean;
        squares += mean * mean;
    }
    const double mean = sum / enough_passes;
    return {mean, std::sqrt((squares / enough_passes - mean * mean) / (enough_passes - 1))};
}

RenderJob room_job(int path_length, int lanes, Roulette roulette = Roulette::off) {
    RenderJob job;
    job.size = {24, 24};
    job.spp = 32;
    job.path_length = path_length;
    job.lanes = lanes;
    job.variant.roulette = roulette;
    return job;
}

/// By the product's own kernels, or those of a folder.
Found found_in(const Integrator& row, const Scene& scene, const RenderJob& job,
               const std::string& folder = "") {
    const ocl::Device device = all_devices().front();
    const ocl::Program program =
        ocl::build(device, kernel_source(row.file(), folder), row.options(device, scene, job));
    return found_by(
        [&](const RenderJob& seeded) { return finish(*row.make(device, program, scene, seeded)); }, job);
}

void expect_found(const std::string& kernel, const Scene& scene, int path_length, double expected,
                  double error, Roulette roulette = Roulette::off) {
    const Integrator& row = integrator(kernel);
    std::set<int> widths{1};  // with meshes there is no other
    if (scene.meshes.empty()) widths.insert(default_lanes(row, all_devices().front().info));
    for (const int lanes : widths) {
        SCOPED_TRACE(fmt::format("{}, lanes {}, path length {}", kernel, lanes, path_length));
        const Found found = found_in(row, scene, room_job(path_length, lanes, roulette));
        EXPECT_LT(found.standard_error, error * expected) << "more samples, or a fault is missed";
        EXPECT_LT(std::abs(found.z(expected)), 4.5) << found.mean << ", " << expected << " expected";
    }
}

TEST(Bdpt, a_room_has_the_light_of_every_bounce) {
    for (const double lamp_radius : {2.0, 5.0})
        for (const int path_length : {2, 6})
            expect_found("bdpt", room_of_lamp(lamp_radius), path_length,
                         wall_radiance(lamp_radius, path_length), 0.001);
}

TEST(Bdpt, roulette_changes_none_of_it) {
    expect_found("bdpt", room_of_lamp(5), 6, wall_radiance(5, 6), 0.002, Roulette::albedo);
}

constexpr double lamp_in_glass = 2, glass_radius = 4;

Scene room_of_glass() {
    Scene scene = room_of_lamp(lamp_in_glass);
    add(scene, {0, 0, 0}, glass_radius, glass(ior));
    return scene;
}

/// Of light that meets the glass on its way to the lamp alone.
double glass_wall_radiance(int path_length) {
    const double once =
        room_albedo * taken_by(ior * lamp_in_glass) * radiance * passed_of_lamp(lamp_in_glass, glass_radius);
    return path_length == 3 ? once : once * (1 + room_albedo * (1 - taken_by(glass_radius)));
}

TEST(Bdpt, a_lamp_in_a_glass_ball_looks_larger_and_a_little_darker) {
    for (const int path_length : {3, 4})
        expect_found("bdpt", room_of_glass(), path_length, glass_wall_radiance(path_length), 0.01);
}

/// The camera in a box of triangles, with one more box and a ball in it, that all shine and scatter half: so
/// light is the same everywhere, whatever hides what, and comes from triangles' either side.
Scene glowing_room() {
    const Material wall = glowing_wall({1, 1, 1}, {0.5, 0.5, 0.5});
    Scene scene;
    scene.camera = {{-2, 0.5, 0}, {1, -0.2, 0.3}, {0, 1, 0}, 80};
    add_shape(scene, "box", 1, {3, {}, {}}, wall);
    add_shape(scene, "box", 0, {0.8, {10, 20, 30}, {1, -1, 0.5}}, wall);
    add(scene, {0.5, 1.5, -1}, 0.7, wall);
    return scene;
}

double glow(int path_length) { return (1 - std::pow(0.5, path_length)) / (1 - 0.5); }

TEST(Bdpt, a_room_of_triangles_that_shine_is_as_bright_everywhere) {
    for (const int path_length : {2, 5})
        expect_found("bdpt", glowing_room(), path_length, glow(path_length), 0.001);
    expect_found("bdpt", glowing_room(), 5, glow(5), 0.002, Roulette::albedo);
}

/// The camera beside a box that shines half and scatters half, both in a ball of glass made of triangles in a
/// room of lamps: all looks as bright as they do, since glass keeps no light.
Scene glowing_glass() {
    Scene scene;
    scene.camera = {{-0.6, 0.3, 0}, {1, 0, 0}, {0, 1, 0}, 60};
    add_shape(scene, "box", 1, {5, {}, {}}, lamp({1, 1, 1}));
    add_shape(scene, "sphere", 3, {2, {}, {}}, glass(ior));
    add_shape(scene, "box", 0, {0.4, {10, 20, 30}, {0.3, 0, 0}},
              glowing_wall({0.5, 0.5, 0.5}, {0.5, 0.5, 0.5}));
    return scene;
}

TEST(Bdpt, light_goes_through_glass_of_triangles_and_is_kept) {
    expect_found("bdpt", glowing_glass(), 10, 1, 0.001);
}

TEST(LightTracing, light_goes_through_glass_of_triangles_and_is_kept) {
    expect_found("pt_lt", glowing_glass(), 10, 1, 0.001);
}

TEST(LightTracing, shares_the_light_of_a_lamp_in_glass_with_paths_that_meet_it) {
    for (const Roulette roulette : {Roulette::off, Roulette::albedo})
        expect_found("pt_lt", room_of_glass(), 4, glass_wall_radiance(4), 0.005, roulette);
}

TEST(Bdpt, halves_of_sums_added_by_themselves_make_the_same_bits) {
    const Scene scene = shipped_scene("thesis");
    const ocl::Device device = all_devices().front();
    const RenderJob job = room_job(4, 4);
    const Film whole_words = finish(*make_render(device, "bdpt", scene, job));
    const Film halves = finish(*make_render(device, "bdpt", scene, job, " -DENGINE_SPLIT_ATOMICS"));
    EXPECT_EQ(whole_words.mean.rgb, halves.mean.rgb);
    EXPECT_GT(whole_words.light_segments, whole_words.samples);
    EXPECT_EQ(whole_words.light_segments, halves.light_segments);
}

TEST(Bdpt, samples_do_not_depend_on_those_of_other_lanes) {
    const Scene scene = shipped_scene("thesis");
    const ocl::Device device = all_devices().front();
    const RenderJob job = room_job(6, 4, Roulette::albedo);  // paths of many lengths
    const auto render = make_render(device, "bdpt", scene, job);
    const Film at_once = finish(*render);
    render->restart();
    EXPECT_EQ(finish(*render, 500).mean.rgb, at_once.mean.rgb);
}

/// Standard errors by which the kernel with a fault misses what the formula says.
double missed_by(const Planted& fault, const Scene& scene, const RenderJob& job, double expected,
                 const std::string& kernel = "bdpt") {
    return std::abs(found_in(integrator(kernel), scene, job, plant(fault).string()).z(expected));
}

TEST(Bdpt, wrong_shares_are_found) {
    for (const Planted& fault : {
             Planted{"odds of the light path x 1.1", "bdpt/vertex.h",
                     "vertex.odds = odds->last + odds->earlier * vertex.density;",
                     "vertex.odds = 1.1f * (odds->last + odds->earlier * vertex.density);"},
             Planted{"density of asking x 1.1", "bdpt/lamp.h", "odds->earlier * density.part / density.whole",
                     "1.1f * odds->earlier * density.part / density.whole"},
             Planted{"density of leaving the lamp x 1.1", "bdpt/join.h",
                     "lamp.area_density * (1.0f / PI) * view->odds",
                     "1.1f * lamp.area_density * (1.0f / PI) * view->odds"},
             Planted{
                 "the picture's density of a pixel", "engine/splat.h",
                 "return inverse_of_frame(&picture->frame, cosine);",
                 "return inverse_of_frame(&picture->frame, cosine) / (picture->width * picture->height);"},
             Planted{"light that the camera sees is left out", "bdpt/bdpt.cl",
                     "    show_all(world, picture, light, &path->inside, traced COUNTED_ARGUMENT);\n", ""},
             Planted{"what is met counts in full", "bdpt/join.h", "whole / (whole + others), is_lamp",
                     "(lanes_f)(1.0f), is_lamp"},
             Planted{"a vertex too few is joined", "bdpt/bdpt.cl", "segment + i + 1u < ENGINE_PATH_LENGTH",
                     "segment + i + 2u < ENGINE_PATH_LENGTH"},
         }) {
        SCOPED_TRACE(fault.name);
        EXPECT_GT(missed_by(fault, room_of_lamp(5), room_job(4, 8), wall_radiance(5, 4)), 6);
    }
}

TEST(Bdpt, wrong_roulette_is_found) {
    const Planted left_out{"the chance to go on left out of a density", "bdpt/vertex.h",
                           "vertex.density = met->goes_on * (1.0f / PI);",
                           "vertex.density = (lanes_f)(1.0f / PI);"};
    const RenderJob job = room_job(4, 8, Roulette::albedo);
    EXPECT_GT(missed_by(left_out, room_of_lamp(5), job, wall_radiance(5, 4)), 6);
}

TEST(Bdpt, wrong_glass_is_found) {
    for (const Planted& fault :
         {Planted{"light that passes glass is not scaled", "bdpt/vertex.h",
                  "if (carries) path->throughput = vec_scale(path->throughput, squeezed);", ""},
          Planted{"odds that pass glass are not scaled", "bdpt/vertex.h",
                  "odds->earlier = odds->earlier * squeezed;", "if (carries) odds->earlier *= squeezed;"}}) {
        SCOPED_TRACE(fault.name);
        EXPECT_GT(missed_by(fault, room_of_glass(), room_job(3, 8), glass_wall_radiance(3)), 6);
    }
}

TEST(Bdpt, wrong_triangles_are_found) {
    for (const Planted& fault : {
             Planted{"paths start on one side of a triangle", "scene/lamps.h",
                     "(int)draw->u < 0 ? -1.0f : 1.0f", "1.0f"},
             Planted{"area of one side in what is left and asked", "scene/lamps.h",
                     "is_triangle(lamp) ? 0.5f * lamp->cap_density : lamp->cap_density", "lamp->cap_density"},
             Planted{"area of one side in what is met", "engine/light.h",
                     "met.area_density = 0.5f * density;", "met.area_density = density;"},
             Planted{"density of asking x 1.1", "scene/lamps.h", "{density_by_area * distance * distance,",
                     "{1.1f * density_by_area * distance * distance,"},
             Planted{"cosine left out of the density of asking", "scene/lamps.h",
                     "fabs(vec_dot(direction, normal))}", "(float)(direction.x == direction.x)}"},
         }) {
        SCOPED_TRACE(fault.name);
        EXPECT_GT(missed_by(fault, glowing_room(), room_job(4, 1), glow(4)), 6);
    }
}

TEST(Bdpt, wrong_glass_of_triangles_is_found) {
    const Planted unseen{"a ray that passes glass of triangles does not know it", "scene/meet.h",
                         "ray->passed = through;", "ray->passed = false;"};
    for (const std::string kernel : {"bdpt", "pt_lt"})
        EXPECT_GT(missed_by(unseen, glowing_glass(), room_job(10, 1), 1, kernel), 6) << kernel;
}

TEST(LightTracing, wrong_shares_are_found) {
    for (const Planted& fault : {
             Planted{"odds of what is shown x 1.2", "pt_lt/odds.h",
                     "vertex.odds = path->odds * met->goes_on;",
                     "vertex.odds = 1.2f * path->odds * met->goes_on;"},
             Planted{"odds of what is met x 1.2", "engine/light.h",
                     "const lanes_f odds = lanes_max(path->odds",
                     "const lanes_f odds = 1.2f * lanes_max(path->odds"},
             Planted{"what is met counts in full", "engine/light.h", "share / (1.0f +",
                     "share / (1.0f + 0.0f *"},
             Planted{"glass left out of the odds of what is met", "pt_lt/odds.h",
                     "path->odds = path->odds * squeezed_by(&surface, path, before);", ";"},
             Planted{"glass left out of the odds of what is shown", "pt_lt/odds.h",
                     "path->odds = path->odds * factor;", ";"},
             Planted{"light that passes glass is not scaled", "pt_lt/odds.h",
                     "path->throughput = vec_scale(path->throughput, factor);", ";"},
         }) {
        SCOPED_TRACE(fault.name);
        EXPECT_GT(missed_by(fault, room_of_glass(), room_job(4, 8), glass_wall_radiance(4), "pt_lt"), 6);
    }
}

TEST(LightTracing, light_that_lamps_are_asked_for_is_not_shown_again) {
    const Planted twice{"paths that meet matte surfaces first are shown, too", "pt_lt/pt_lt.cl",
                        "alive & !(fresh & met.matte) & !met.ends", "alive & !met.ends"};
    EXPECT_LT(std::abs(found_in(integrator("pt_lt"), room_of_lamp(5), room_job(4, 8)).z(wall_radiance(5, 4))),
              4.5);
    EXPECT_GT(missed_by(twice, room_of_lamp(5), room_job(4, 8), wall_radiance(5, 4), "pt_lt"), 6);
}

TEST(LightTracing, wrong_roulette_is_found) {
    const Planted left_out{"the chance to go on left out of the odds of what is shown", "pt_lt/odds.h",
                           "vertex.odds = path->odds * met->goes_on;", "vertex.odds = path->odds;"};
    const RenderJob job = room_job(4, 8, Roulette::albedo);
    EXPECT_GT(missed_by(left_out, room_of_glass(), job, glass_wall_radiance(4), "pt_lt"), 6);
}

}  // namespace
}  // namespace ptb
