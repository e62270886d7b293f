// What samples say of differences between pixels, against differences of the truth.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "bench/validate/blocks.h"
#include "bench/validate/passes.h"
#include "core/oracle/reference.h"
#include "tests/support/devices.h"
#include "tests/support/planted.h"
#include "tests/support/render_once.h"
#include "tests/support/scenes.h"

namespace ptb {
namespace {

constexpr Size small{32, 32};
constexpr int passes = 16;

/// A number of each pixel.
using Numbers = std::vector<double>;

Numbers brightness(const Image& image) {
    Numbers sums(image.size.pixels());
    for (std::size_t i = 0; i < image.rgb.size(); ++i) sums[i / 3] += image.rgb[i] / 3.0;
    return sums;
}

std::size_t step_of(Aov aov) { return aov == Aov::dx ? 1 : small.width; }

bool has_neighbour(Aov aov, std::size_t pixel) {
    return aov == Aov::dx ? (pixel + 1) % small.width != 0 : pixel + small.width < small.pixels();
}

/// Weights of pixels that make of a picture what these weights make of its differences.
Numbers weights_of_pixels(Aov aov, const Numbers& weights) {
    if (!is_of_gradients(aov) || aov == Aov::primal) return weights;
    Numbers of_pixels(weights.size());
    for (std::size_t i = 0; i < weights.size(); ++i) {
        if (!has_neighbour(aov, i)) continue;
        of_pixels[i + step_of(aov)] += weights[i];
        of_pixels[i] -= weights[i];
    }
    return of_pixels;
}

double product(const Numbers& a, const Numbers& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return sum;
}

/// One way to make a number of what is shown of pixels.
struct Weighing {
    Aov aov;
    Numbers weights;
};

/// Means of quarters of the picture, so large that rare bright samples are among theirs, and for differences
/// one more: all of them, with the signs that they have in another picture.
std::vector<Weighing> weighings(Aov aov, const Numbers& other_picture) {
    std::vector<Weighing> result;
    for (std::size_t block = 0; block < 4; ++block) {
        Numbers weights(small.pixels());
        for (std::size_t i = 0; i < weights.size(); ++i)
            weights[i] = i / 32 / 16 == block / 2 && i % 32 / 16 == block % 2 ? 1.0 / 256 : 0;
        result.push_back({aov, weights});
    }
    if (aov != Aov::dx && aov != Aov::dy) return result;
    Numbers signs(small.pixels());
    double mean = 0;
    for (std::size_t i = 0; i < signs.size(); ++i) {
        if (has_neighbour(aov, i)) signs[i] = other_picture[i + step_of(aov)] - other_picture[i];
        mean += std::abs(signs[i]) / static_cast<double>(signs.size());
    }
    for (double& sign : signs) sign /= std::abs(sign) + mean;
    result.push_back({aov, signs});
    return result;
}

/// A stored picture, and the variance of its pixels.
struct Truth {
    Numbers mean, variance;
};

Truth stored_truth(const std::string& scene) {
    const auto folder = std::filesystem::path(PTB_SOURCE_DIR) / "results/references";
    const auto reference =
        load_reference(folder, reference_name(scene, "pt", {128, 128}, 8), shipped_scene(scene).content);
    EXPECT_TRUE(reference.has_value()) << scene;
    const auto moments = moments_at({reference->mean, reference->variance}, small);
    Truth truth{brightness(moments->mean), {}};
    // Colours of a sample vary together, at most.
    truth.variance = brightness(moments->variance);
    for (double& value : truth.variance) value /= reference->spp * 16.0;
    return truth;
}

/// Renders of one kernel.
class Renderer {
  public:
    Renderer(const std::string& kernel, Scene scene, RenderJob job, const std::string& folder = "")
        : scene_(std::move(scene)), job_(job), row_(integrator(kernel)), device_(all_devices().front()) {
        job_.size = small;
        program_ =
            ocl::build(device_, kernel_source(row_.file(), folder), row_.options(device_, scene_, job_));
    }

    Numbers picture(Aov aov, std::uint32_t seed, int spp) const {
        RenderJob job = job_;
        job.aov = aov;
        job.seed = seed;
        job.spp = spp;
        return brightness(finish(*row_.make(device_, *program_, scene_, job)).mean);
    }

    /// Of each seed.
    std::vector<Numbers> pictures(Aov aov) const {
        std::vector<Numbers> result;
        for (std::uint32_t seed = 1; seed <= passes; ++seed) result.push_back(picture(aov, seed, job_.spp));
        return result;
    }

  private:
    Scene scene_;
    RenderJob job_;
    const Integrator& row_;
    ocl::Device device_;
    std::optional<ocl::Program> program_;
};

double mean_of(const std::vector<double>& values) {
    double sum = 0;
    for (const double value : values) sum += value;
    return sum / static_cast<double>(values.size());
}

/// Standard errors, of a normal number, between the mean of such values and what is expected.
double z_of(const std::vector<double>& values, double expected, double expected_variance) {
    const double mean = mean_of(values);
    double variance = 0;
    for (const double value : values) variance += (value - mean) * (value - mean) / (passes - 1) / passes;
    if (variance + expected_variance == 0) return std::abs(mean - expected) < 1e-9 ? 0 : 1e9;
    return student_z(mean - expected, expected_variance, variance, passes - 1);
}

double worst_against(const Truth& truth, const Renderer& renderer, Aov aov) {
    const auto pictures = renderer.pictures(aov);
    double worst = 0;
    for (const Weighing& each : weighings(aov, renderer.picture(Aov::radiance, 1000, 32))) {
        const Numbers of_pixels = weights_of_pixels(aov, each.weights);
        double variance = 0;
        for (std::size_t i = 0; i < of_pixels.size(); ++i)
            variance += of_pixels[i] * of_pixels[i] * truth.variance[i];
        std::vector<double> values;
        for (const Numbers& picture : pictures) values.push_back(product(picture, each.weights));
        worst = std::max(worst, std::abs(z_of(values, product(of_pixels, truth.mean), variance)));
    }
    return worst;
}

RenderJob job_of(int path_length, Roulette roulette = Roulette::off) {
    RenderJob job;
    job.spp = 8;
    job.path_length = path_length;
    job.lanes = 8;
    job.variant.roulette = roulette;
    return job;
}

/// Standard errors that right kernels stay below, and wrong ones do not.
constexpr double sure = 4.5;

void expect_truth(const std::string& kernel, const std::vector<std::string>& scenes) {
    for (const std::string& scene : scenes) {
        const Truth truth = stored_truth(scene);
        const Renderer renderer(kernel, shipped_scene(scene), job_of(8));
        for (const Aov aov : {Aov::primal, Aov::dx, Aov::dy, Aov::radiance}) {
            SCOPED_TRACE(fmt::format("{}, {}", scene, aov_names[static_cast<std::size_t>(aov)]));
            EXPECT_LT(worst_against(truth, renderer, aov), sure);
        }
    }
}

TEST(Gradients, of_both_ends_agree_with_differences_of_the_stored_truth) {
    expect_truth("gbdpt", {"eclipse", "gap", "thesis", "caustic", "lamp_in_glass"});
}

/// Where lamps can be asked: elsewhere rare bright samples leave no mean to test.
TEST(Gradients, of_camera_paths_agree_with_differences_of_the_stored_truth) {
    expect_truth("gpt", {"thesis", "gap", "free_light"});
}

/// Between differences that samples tell and those of what they say of pixels.
double worst_within(const Renderer& renderer, Aov aov, const std::vector<Numbers>& primal) {
    const auto pictures = renderer.pictures(aov);
    double worst = 0;
    for (const Weighing& each : weighings(aov, renderer.picture(Aov::radiance, 1000, 32))) {
        const Numbers of_pixels = weights_of_pixels(aov, each.weights);
        std::vector<double> values;
        for (std::size_t i = 0; i < pictures.size(); ++i)
            values.push_back(product(pictures[i], each.weights) - product(primal[i], of_pixels));
        worst = std::max(worst, std::abs(z_of(values, 0, 0)));
    }
    return worst;
}

TEST(Gradients, agree_with_differences_of_their_own_picture) {
    struct Trial {
        std::string kernel, name;
        Scene scene;
        RenderJob job;
    };
    for (const Trial& trial : {
             Trial{"gbdpt", "camera in glass", camera_in_glass(), job_of(6)},
             Trial{"gbdpt", "lamps that scatter, glass in glass", nested_glass(), job_of(6)},
             Trial{"gbdpt", "many lamps", shipped_scene("lamps"), job_of(4)},
             Trial{"gbdpt", "roulette", shipped_scene("thesis"), job_of(8, Roulette::albedo)},
             Trial{"gbdpt", "path length 1", shipped_scene("thesis"), job_of(1)},
             Trial{"gbdpt", "path length 2", shipped_scene("thesis"), job_of(2)},
             Trial{"gbdpt", "path length 3", shipped_scene("thesis"), job_of(3)},
             Trial{"gpt", "camera in glass", camera_in_glass(), job_of(6)},
             Trial{"gpt", "path length 1", shipped_scene("thesis"), job_of(1)},
             Trial{"gpt", "path length 2", shipped_scene("thesis"), job_of(2)},
             Trial{"gpt", "lamps that scatter, glass in glass", nested_glass(), job_of(6)},
             Trial{"gpt", "many lamps, roulette", shipped_scene("lamps"), job_of(4, Roulette::albedo)},
         }) {
        const Renderer renderer(trial.kernel, trial.scene, trial.job);
        const auto primal = renderer.pictures(Aov::primal);
        for (const Aov aov : {Aov::dx, Aov::dy}) {
            SCOPED_TRACE(fmt::format("{}, {}, {}", trial.kernel, trial.name,
                                     aov_names[static_cast<std::size_t>(aov)]));
            EXPECT_LT(worst_within(renderer, aov, primal), sure);
        }
    }
}

TEST(Gradients, wrong_shifts_are_found) {
    struct Trial {
        Planted fault;
        const char* scene;
        int spp;
        const char* kernel = "gbdpt";
    };
    for (const Trial& trial :
         {Trial{{"a failing shift counts half", "gbdpt/offset.h",
                 "const lanes_f inverse = 1.0f / (sum + other_sum);",
                 "const lanes_f inverse = lanes_select((lanes_f)(1.0f), (lanes_f)(0.5f), other_sum == 0.0f)"
                 " / (sum + other_sum);"},
                "thesis",
                8},
          Trial{{"the cosine at the shifted vertex is dropped", "gbdpt/offset.h",
                 "const lanes_f geometry = cosine * along", "const lanes_f geometry = along"},
                "gap",
                32},
          Trial{{"the ratio of densities is squared", "gbdpt/offset.h",
                 "lanes_min(geometry * odds->last * offset->likelihood, (lanes_f)(MOST_LIKELY))",
                 "lanes_min(geometry * odds->last * offset->likelihood * geometry * odds->last * "
                 "offset->likelihood * first.density, (lanes_f)(MOST_LIKELY))"},
                "gap",
                32},
          Trial{{"one direction's sign", "engine/gradients.h",
                 "(lanes_f)((neighbour & 1u) == 0u ? 1.0f : -1.0f)", "(lanes_f)(1.0f)"},
                "thesis",
                8},
          Trial{{"a shifted path is sent half of what it asks for", "gbdpt/joins.h",
                 "vec_mul(asked->radiance, view->weight), ratio * cosine)",
                 "vec_mul(asked->radiance, view->weight), 0.5f * ratio * cosine)"},
                "free_light",
                128,
                "gpt"},
          Trial{{"light that the camera sees is not shifted", "gbdpt/show.h",
                 "    add_gradient(picture, neighbour, place, more, squared_mean(more), there "
                 "COUNTED_ARGUMENT);\n",
                 ""},
                "eclipse",
                8}}) {
        SCOPED_TRACE(fmt::format("{}, {}, {}", trial.kernel, trial.fault.name, trial.scene));
        RenderJob job = job_of(8);
        job.spp = trial.spp;
        const Renderer wrong(trial.kernel, shipped_scene(trial.scene), job, plant(trial.fault).string());
        const Truth truth = stored_truth(trial.scene);
        const auto primal = wrong.pictures(Aov::primal);
        double worst = 0;
        for (const Aov aov : {Aov::dx, Aov::dy})
            worst = std::max({worst, worst_against(truth, wrong, aov), worst_within(wrong, aov, primal)});
        EXPECT_GT(worst, sure);
    }
}

}  // namespace
}  // namespace ptb
