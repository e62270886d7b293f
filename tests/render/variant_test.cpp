#include <algorithm>
#include <functional>
#include <numeric>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "core/oracle/oracle.h"
#include "tests/support/devices.h"
#include "tests/support/image_check.h"
#include "tests/support/render_once.h"
#include "tests/support/scenes.h"

namespace ptb {
namespace {

RenderJob job_of(int edge, int spp, int path_length) {
    RenderJob job;
    job.size = {edge, edge};
    job.spp = spp;
    job.path_length = path_length;
    return job;
}

OracleResult truth_of(const Scene& scene, const RenderJob& job, int spp) {
    OracleJob work;
    work.size = job.size;
    work.spp = spp;
    work.path_length = job.path_length;
    work.seed = 77;
    work.threads = 2;
    work.pixel_centres = job.variant.pixel_filter == PixelFilter::centre;
    return trace_pt(scene, work);
}

/// Renders the job with one and with eight lanes on every device and judges it against the host's tracer.
void expect_truth(const std::string& name, RenderJob job) {
    const Scene scene = shipped_scene("free_light");
    OracleJob as_made;
    as_made.size = job.size;
    as_made.spp = 256;
    as_made.path_length = job.path_length;
    const Reference truth = reference_of(truth_of(scene, job, as_made.spp), scene, "pt", as_made);
    on_every_device([&](const ocl::Device& device) {
        for (const int lanes : {1, 8}) {
            job.lanes = lanes;
            EXPECT_TRUE(
                agrees(name + std::to_string(lanes), render_film(device, "pt", scene, job), job, truth));
        }
    });
}

TEST(Variants, park_miller_paths_agree_with_the_host) {
    RenderJob job = job_of(48, 256, 5);
    job.variant.rng = Rng::park_miller;
    expect_truth("park_miller", job);
}

TEST(Variants, strict_arithmetic_agrees_with_the_host) {
    RenderJob job = job_of(48, 256, 5);
    job.variant.build = BuildMode::strict;
    expect_truth("strict", job);
}

TEST(Variants, stratified_pixels_agree_with_the_host) {
    RenderJob job = job_of(48, 250, 5);  // 10 columns, 25 rows
    job.variant.pixel_filter = PixelFilter::stratified;
    expect_truth("stratified", job);
}

TEST(Variants, pixel_centres_agree_with_the_host) {
    RenderJob job = job_of(48, 256, 5);
    job.variant.pixel_filter = PixelFilter::centre;
    expect_truth("centre", job);
}

/// Every sample of a pixel goes the same way, so what is seen directly has no variance.
TEST(Variants, samples_at_a_pixel_s_centre_are_all_alike) {
    RenderJob job = job_of(32, 16, 1);
    const auto varying = [&](const ocl::Device& device) {
        const Film film = render_film(device, "pt", shipped_scene("free_light"), job);
        return std::count_if(film.variance->rgb.begin(), film.variance->rgb.end(),
                             [](float v) { return v > 0; });
    };
    on_every_device([&](const ocl::Device& device) {
        job.variant.pixel_filter = PixelFilter::jitter;
        EXPECT_GT(varying(device), 0) << "the light has no edge in this picture";
        job.variant.pixel_filter = PixelFilter::centre;
        EXPECT_EQ(varying(device), 0);
    });
}

double squared_error(const Image& image, const Image& truth) {
    return std::transform_reduce(image.rgb.begin(), image.rgb.end(), truth.rgb.begin(), 0.0, std::plus<>(),
                                 [](float a, float b) { return (a - b) * (a - b); });
}

/// At the edge of a light a pixel of n cells errs with the cells that the edge crosses: some sqrt(n) of them.
TEST(Variants, strata_lessen_the_noise_of_edges) {
    RenderJob job = job_of(32, 64, 1);
    const Scene scene = shipped_scene("free_light");
    const Image truth = truth_of(scene, job, 16384).mean;
    on_every_device([&](const ocl::Device& device) {
        job.variant.pixel_filter = PixelFilter::jitter;
        const double jittered = squared_error(render_film(device, "pt", scene, job).mean, truth);
        job.variant.pixel_filter = PixelFilter::stratified;
        EXPECT_LT(squared_error(render_film(device, "pt", scene, job).mean, truth), jittered / 2);
    });
}

/// The state after 9 999 steps of one draw each and one more, in every lane; states start at 1.
TEST(Variants, park_miller_s_ten_thousandth_number_is_that_of_the_paper) {
    KernelSource source = kernel_source("pt/pt.cl");
    source.text +=
        "\n__kernel void draw(__global uint* out) {\n"
        "    lanes_u state = (lanes_u)(1u);\n"
        "    for (int i = 0; i < 10000; ++i) state = park_miller(state);\n"
        "    for (int i = 0; i < PTB_LANES; ++i) out[i] = LANE(state, i);\n"
        "}\n";
    on_every_device([&](const ocl::Device& device) {
        for (const int lanes : {1, 4, 16}) {
            const std::string options =
                "-cl-std=CL1.2 -DPTB_PARK_MILLER -DPTB_LANES=" + std::to_string(lanes);
            cl::Kernel kernel(ocl::build(device, source, options).program, "draw");
            std::vector<std::uint32_t> numbers(static_cast<std::size_t>(lanes));
            const cl::Buffer out(device.context, CL_MEM_WRITE_ONLY, numbers.size() * sizeof(std::uint32_t));
            kernel.setArg(0, out);
            device.queue.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(1));
            device.queue.enqueueReadBuffer(out, CL_TRUE, 0, numbers.size() * sizeof(std::uint32_t),
                                           numbers.data());
            EXPECT_EQ(numbers, std::vector<std::uint32_t>(numbers.size(), 1043618065u)) << lanes << " lanes";
        }
    });
}

std::string refusal_of(const ocl::Device& device, const std::string& kernel, const Scene& scene,
                       void (*change)(RenderJob&)) {
    RenderJob job = job_of(8, 1, 2);
    change(job);
    return unsupported_reason(integrator(kernel), device, scene, job);
}

TEST(Variants, what_means_nothing_is_refused_with_the_reason) {
    const Scene scene = shipped_scene("thesis");
    on_every_device([&](const ocl::Device& device) {
        EXPECT_EQ(refusal_of(device, "thesis", shipped_scene("cornell"), [](auto&) {}),
                  "scene cornell has meshes: thesis sees spheres alone");
        EXPECT_EQ(refusal_of(device, "thesis", scene, [](auto& j) { j.variant.rng = Rng::hash; }),
                  "rng hash: thesis has auto, park_miller");
        EXPECT_EQ(
            refusal_of(device, "thesis", scene, [](auto& j) { j.variant.film_memory = FilmMemory::image; }),
            "film_memory image: thesis has buffer");
        EXPECT_EQ(refusal_of(device, "pt", scene,
                             [](auto& j) { j.variant.dispatch = Dispatch::tasks, j.work_group_x = 64; }),
                  "dispatch tasks: a task is one work-item, so work_group has to be implicit");
        EXPECT_EQ(refusal_of(device, "pt", mixed_balls(40),
                             [](auto& j) { j.variant.scene_memory = SceneMemory::argument; }),
                  "scene_memory argument: pt takes at most 15 faces so, these 40 spheres have 49");
        EXPECT_THAT(
            refusal_of(device, "pt", mixed_balls(100'000),
                       [](auto& j) { j.variant.scene_memory = SceneMemory::local; }),
            testing::StartsWith("scene_memory local: 100000 spheres take 11200240 bytes, this device has "));
        EXPECT_EQ(refusal_of(device, "pt", scene,
                             [](auto& j) {
                                 j.variant.pixel_filter = PixelFilter::stratified;
                                 j.spp = 4'194'319;  // a prime number
                             }),
                  "pixel_filter stratified: 4194319 samples make a grid of 4194319 rows, pt takes at most "
                  "4194303");
        EXPECT_EQ(refusal_of(device, "pt", scene, [](auto&) {}), "");
    });
}

}  // namespace
}  // namespace ptb
