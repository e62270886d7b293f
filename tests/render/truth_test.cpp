#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <fmt/format.h>

#include "core/oracle/oracle.h"
#include "shared/engine.h"
#include "tests/support/devices.h"
#include "tests/support/image_check.h"
#include "tests/support/render_once.h"
#include "tests/support/scenes.h"

namespace ptb {
namespace {

/// What to compare, and with how much work on either side.
struct Trial {
    std::string name;
    Scene scene;
    int edge = 48, spp = 64, path_length = 5, oracle_spp = 64;
};

Reference traced(const Trial& trial, const std::string& kernel) {
    OracleJob job;
    job.size = {trial.edge, trial.edge};
    job.spp = trial.oracle_spp;
    job.path_length = trial.path_length;
    job.seed = 99;
    job.threads = 2;
    return reference_of(tracers().at(truth_of(kernel))(trial.scene, job), trial.scene, kernel, job);
}

std::string file_name(const Trial& trial, const std::string& kernel, const ocl::Device& device, int lanes) {
    std::string name = fmt::format("{}_{}_{}_lanes{}", trial.name, kernel, device.info.key, lanes);
    for (char& c : name) c = c == ':' ? '_' : c;
    return name;
}

/// Renders the trial with every lane width on every device and judges each against the host's tracer.
void expect_truth(const Trial& trial, const std::string& kernel) {
    const Reference truth = traced(trial, kernel);
    on_every_device([&](const ocl::Device& device) {
        for (const int lanes : integrator(kernel).lanes) {
            RenderJob job;
            job.size = {trial.edge, trial.edge};
            job.spp = trial.spp;
            job.path_length = trial.path_length;
            job.lanes = lanes;
            const Film film = render_film(device, kernel, trial.scene, job);
            EXPECT_TRUE(agrees(file_name(trial, kernel, device, lanes), film, job, truth));
        }
    });
}

TEST(Truth, pt_agrees_on_the_thesis_scene) {
    expect_truth({"thesis_pl2", shipped_scene("thesis"), 48, 256, 2, 256}, "pt");
    expect_truth({"thesis_pl5", shipped_scene("thesis"), 48, 256, 5, 256}, "pt");
}

TEST(Truth, pt_agrees_on_the_free_light_scene) {
    expect_truth({"free_light_pl2", shipped_scene("free_light"), 48, 256, 2, 256}, "pt");
    expect_truth({"free_light_pl5", shipped_scene("free_light"), 48, 256, 5, 256}, "pt");
}

TEST(Truth, thesis_kernel_agrees_with_its_twin) {
    expect_truth({"thesis_pl2", shipped_scene("thesis"), 48, 256, 2, 256}, "thesis");
    expect_truth({"thesis_pl5", shipped_scene("thesis"), 48, 256, 5, 256}, "thesis");
    expect_truth({"free_light_pl5", shipped_scene("free_light"), 48, 256, 5, 256}, "thesis");
}

TEST(Truth, all_that_ask_lamps_agree_on_a_scene_of_many) {
    for (const std::string kernel : {"pt_nee", "direct", "whitted"})
        expect_truth({"lamps_pl5", shipped_scene("lamps"), 48, 256, 5, 256}, kernel);
}

TEST(Truth, camera_in_a_glass_ball) {
    expect_truth({"camera_in_glass", camera_in_glass(), 48, 128, 12, 128}, "pt");
}

TEST(Truth, glass_in_glass_in_glass) {
    expect_truth({"nested_glass", nested_glass(), 48, 128, 16, 128}, "pt");
}

TEST(Truth, forty_glass_balls_need_two_words_of_sides) {
    expect_truth({"glass_balls", glass_balls(40), 32, 64, 12, 64}, "pt");
}

TEST(Truth, fifteen_spheres_fill_the_table) {
    expect_truth({"balls_15", mixed_balls(15), 48, 64, 8, 64}, "pt");
}

TEST(Truth, sixteen_spheres_leave_the_table) {
    expect_truth({"balls_16", mixed_balls(16), 48, 64, 8, 64}, "pt");
}

TEST(Truth, five_hundred_spheres) { expect_truth({"balls_500", mixed_balls(500), 24, 32, 4, 32}, "pt"); }

TEST(Truth, ten_thousand_spheres_lie_in_global_memory) {
    const Scene scene = mixed_balls(10'000);
    on_every_device([&](const ocl::Device& device) {
        // 2000 are of glass and the camera is in the dome, which have two faces; two rows more.
        const bool large = 10'000 * 16 + (10'000 + 2001 + 2) * 80 > device.info.constant_bytes;
        const std::string in_global = "-DSCENE_SPHERES=" + std::to_string(SCENE_IN_GLOBAL);
        EXPECT_EQ(integrator("pt").options(device, scene, {}).find(in_global) != std::string::npos, large);
    });
    expect_truth({"balls_10000", scene, 8, 8, 3, 16}, "pt");
}

TEST(Truth, pt_agrees_with_the_stored_references) {
    const auto folder = std::filesystem::path(PTB_SOURCE_DIR) / "results/references";
    int found = 0;
    for (const std::string scene : {"thesis", "free_light", "furnace", "lamps"}) {
        const auto reference = load_reference(folder, reference_name(scene, "pt", validation_size, 5),
                                              shipped_scene(scene).content);
        if (!reference) continue;
        ++found;
        on_every_device([&](const ocl::Device& device) {
            RenderJob job;
            job.size = validation_size;
            job.spp = 64;
            job.path_length = 5;
            job.lanes = device.info.default_lanes;
            const Film film = render_film(device, "pt", shipped_scene(scene), job);
            EXPECT_TRUE(
                agrees(fmt::format("{}_stored_{}", scene, device.info.device_index), film, job, *reference));
        });
    }
    if (found == 0) GTEST_SKIP() << "no reference in " << folder;
}

TEST(Truth, wrong_image_is_refused_and_left_behind) {
    const Trial trial{"wrong_on_purpose", shipped_scene("free_light"), 64, 64, 2, 64};
    const Reference truth = traced(trial, "pt");
    Film film;
    film.mean = truth.mean;
    film.variance = truth.variance;
    film.samples = 64u * 64u * 64u;
    film.segments = static_cast<std::uint64_t>(truth.segments_per_sample * 64 * 64 * 64 + 0.5);
    RenderJob job;
    job.size = truth.size;
    job.spp = trial.spp;
    job.path_length = 2;
    EXPECT_TRUE(agrees("not_wrong", film, job, truth));
    for (std::size_t i = 0; i < film.mean.rgb.size() / 2; ++i) film.mean.rgb[i] *= 1.5f;
    const auto verdict = agrees("wrong_on_purpose", film, job, truth);
    EXPECT_FALSE(verdict);
    const auto folder = std::filesystem::path(PTB_BINARY_DIR) / "failed_images";
    for (const std::string kind : {"image", "reference", "z"}) {
        const auto file = folder / ("wrong_on_purpose_" + kind + ".png");
        EXPECT_TRUE(std::filesystem::remove(file)) << file;
    }
}

}  // namespace
}  // namespace ptb
