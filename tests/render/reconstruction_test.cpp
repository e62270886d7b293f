// Pictures made of gradients, against ones that a cosine transform makes of the same, and against the truth.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "bench/validate/passes.h"
#include "core/integrator/gradients.h"
#include "tests/support/devices.h"
#include "tests/support/planted.h"
#include "tests/support/poisson.h"
#include "tests/support/render_once.h"
#include "tests/support/scenes.h"

namespace ptb {
namespace {

constexpr double alpha = 0.2;  // of the kernels

std::vector<double> numbers(Size size, std::mt19937& random, double least, double most) {
    std::vector<double> result(size.pixels());
    for (double& number : result) number = std::uniform_real_distribution(least, most)(random);
    return result;
}

TEST(CosineTransform, exact_differences_give_the_picture_back) {
    std::mt19937 random(1);
    const Size size{37, 21};
    const std::vector<double> picture = numbers(size, random, 0, 3);
    const std::vector<double> found = least_squares(differences_of(size, picture), alpha);
    for (std::size_t i = 0; i < picture.size(); ++i) EXPECT_NEAR(found[i], picture[i], 1e-12);
}

TEST(CosineTransform, any_step_away_from_its_picture_adds_its_own_squares) {
    std::mt19937 random(2);
    const Size size{13, 18};
    const Differences noisy{size, numbers(size, random, 0, 2), numbers(size, random, -1, 1),
                            numbers(size, random, -1, 1)};
    const std::vector<double> found = least_squares(noisy, alpha);
    const double least = squared_errors(noisy, alpha, found);
    const std::vector<double> nothing(size.pixels());
    for (int i = 0; i < 20; ++i) {
        const std::vector<double> step = numbers(size, random, -1, 1);
        std::vector<double> there = found;
        for (std::size_t j = 0; j < there.size(); ++j) there[j] += step[j];
        const double of_step = squared_errors({size, nothing, nothing, nothing}, alpha, step);
        EXPECT_NEAR(squared_errors(noisy, alpha, there), least + of_step, 1e-9 * (least + of_step));
    }
}

/// Samples of a pixel as a device sums them, whose reconstruction is asked for.
class Sums {
  public:
    Sums(Size size, std::uint32_t samples) : size_(size), samples_(samples), pixels_(2 * size.pixels()) {}

    enum Kind { radiance, across, down };

    /// One sample of a pixel's first half, or second; all colours alike but for factors of 1, 2 and 4.
    void add(Kind kind, int half, std::size_t pixel, double value) {
        GradientPixel& place = pixels_[static_cast<std::size_t>(half) * size_.pixels() + pixel];
        ptb_long* sums = kind == radiance ? place.radiance : kind == across ? place.across : place.down;
        for (int c = 0; c < 3; ++c) sums[c] += std::llround(std::ldexp(value, scale.radiance + c));
        place.squares[kind] += std::llround(std::ldexp(std::pow(value * 7 / 3, 2), scale.squares));
    }

    /// So many samples in each half that all say the same.
    void add_all(const Differences& d) {
        for (std::uint32_t i = 0; i < samples_; ++i)
            for (std::size_t pixel = 0; pixel < size_.pixels(); ++pixel) {
                const int half = i < (samples_ + 1) / 2 ? 0 : 1;
                add(radiance, half, pixel, d.pixels[pixel]);
                add(across, half, pixel, d.across[pixel]);
                add(down, half, pixel, d.down[pixel]);
            }
    }

    /// The first colour of the picture that the device makes of them; the others are found to be alike.
    std::vector<double> picture(const ocl::Device& device, const ocl::Program& program,
                                Reconstruction method) const {
        RenderJob job;
        job.size = size_;
        job.variant.reconstruction = method;
        GradientStore store(device, program.program, "gbdpt", job, scale);
        Launcher launcher(device, job.variant);
        launcher.queue().enqueueWriteBuffer(store.sums(), CL_TRUE, 0, pixels_.size() * sizeof(GradientPixel),
                                            pixels_.data());
        const Image image = store.picture(launcher, samples_, pixels_);
        launcher.finish();
        std::vector<double> red(size_.pixels());
        for (std::size_t i = 0; i < red.size(); ++i) {
            red[i] = image.rgb[3 * i];
            EXPECT_NEAR(image.rgb[3 * i + 2], 4 * red[i], 1e-4 * (1 + std::abs(red[i])));
        }
        return red;
    }

  private:
    static constexpr FilmScale scale{28, 20};
    Size size_;
    std::uint32_t samples_;
    std::vector<GradientPixel> pixels_;
};

/// Of the product, or of a folder of kernels; the shortest paths, since none is traced.
ocl::Program program_of(const ocl::Device& device, const std::string& folder = "") {
    RenderJob job;
    job.path_length = 1;
    const Integrator& row = integrator("gbdpt");
    return ocl::build(device, kernel_source(row.file(), folder),
                      row.options(device, shipped_scene("eclipse"), job));
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
    double largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
    return largest;
}

double root_mean_square(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
    return std::sqrt(sum / static_cast<double>(a.size()));
}

TEST(Reconstruction, exact_gradients_give_the_picture_back) {
    std::mt19937 random(3);
    const Size size{37, 43};  // two work-groups, one of them not full
    const std::vector<double> picture = numbers(size, random, 1, 3);
    Sums sums(size, 4);
    sums.add_all(differences_of(size, picture));
    on_every_device([&](const ocl::Device& device) {
        const ocl::Program program = program_of(device);
        for (const auto method : {Reconstruction::weighted, Reconstruction::l2, Reconstruction::l1}) {
            SCOPED_TRACE(fmt::format("method {}", static_cast<int>(method)));
            EXPECT_LT(largest_difference(sums.picture(device, program, method), picture), 1e-6);
        }
    });
}

TEST(Reconstruction, least_squares_are_those_of_a_cosine_transform) {
    std::mt19937 random(4);
    on_every_device([&](const ocl::Device& device) {
        const ocl::Program program = program_of(device);
        for (const Size size : {Size{37, 43}, Size{64, 64}, Size{1, 40}, Size{50, 1}, Size{1, 1}}) {
            SCOPED_TRACE(fmt::format("{}x{}", size.width, size.height));
            const Differences noisy{size, numbers(size, random, 0, 2), numbers(size, random, -1, 1),
                                    numbers(size, random, -1, 1)};
            const std::vector<double> exact = least_squares(noisy, alpha);
            Sums sums(size, 3), lone(size, 1);
            sums.add_all(noisy);
            lone.add_all(noisy);
            // Mean brightness is 1; the turns leave up to 7e-4 of it.
            EXPECT_LT(largest_difference(sums.picture(device, program, Reconstruction::l2), exact), 1e-3);
            EXPECT_LT(largest_difference(lone.picture(device, program, Reconstruction::weighted), exact),
                      1e-3)
                << "a lone sample has no other half";
        }
    });
}

/// Few samples have all the light, and all of a difference: those that have seem to vary most.
double brightness_off(const ocl::Device& device, const ocl::Program& program, std::mt19937& random) {
    const Size size{32, 32};
    constexpr double chance = 0.1;
    std::bernoulli_distribution lit(chance), positive(0.5);
    constexpr std::uint32_t samples = 8;
    Sums sums(size, samples);
    double truth = 0;
    for (std::size_t pixel = 0; pixel < size.pixels(); ++pixel) {
        const double light = 1 + static_cast<double>(pixel % 32) / 32;
        truth += light / static_cast<double>(size.pixels());
        for (std::uint32_t i = 0; i < samples; ++i) {
            const int half = i < samples / 2 ? 0 : 1;
            if (lit(random)) sums.add(Sums::radiance, half, pixel, light / chance);
            sums.add(Sums::across, half, pixel, 1.0 / 32 + (lit(random) ? positive(random) ? 1 : -1 : 0));
            sums.add(Sums::down, half, pixel, lit(random) ? positive(random) ? 1 : -1 : 0);
        }
    }
    const std::vector<double> picture = sums.picture(device, program, Reconstruction::weighted);
    double mean = 0;
    for (const double value : picture) mean += value / static_cast<double>(size.pixels());
    return mean - truth;
}

/// Standard errors, of a normal number, by which pictures are too bright.
double bias_of(const ocl::Device& device, const ocl::Program& program) {
    std::mt19937 random(5);
    double sum = 0, squares = 0;
    for (int i = 0; i < enough_passes; ++i) {
        const double off = brightness_off(device, program, random);
        sum += off;
        squares += off * off;
    }
    const double mean = sum / enough_passes;
    return student_z(mean, 0, (squares / enough_passes - mean * mean) / (enough_passes - 1),
                     enough_passes - 1);
}

TEST(Reconstruction, weights_that_do_not_know_the_noise_leave_the_brightness) {
    const ocl::Device device = all_devices().front();
    EXPECT_LT(std::abs(bias_of(device, program_of(device))), 4);
    const Planted same_half{"variance of the half that it weighs", "gbdpt/reconstruct.h",
                            "variance_around(sums, i, 1u - share.problem, &r)",
                            "variance_around(sums, i, share.problem, &r)"};
    EXPECT_LT(bias_of(device, program_of(device, plant(same_half).string())), -6);
}

TEST(Reconstruction, wrong_equations_are_found) {
    std::mt19937 random(6);
    const Size size{37, 43};
    const Differences noisy{size, numbers(size, random, 0, 2), numbers(size, random, -1, 1),
                            numbers(size, random, -1, 1)};
    const std::vector<double> exact = least_squares(noisy, alpha);
    Sums sums(size, 3);
    sums.add_all(noisy);
    const ocl::Device device = all_devices().front();
    for (const Planted& fault :
         {Planted{"one direction's sign", "gbdpt/reconstruct.h",
                  "rest -= edges.left * (x[i] - x[i - 1u] - own[3u * (i - 1u) + 1u]);",
                  "rest -= edges.left * (x[i] - x[i - 1u] + own[3u * (i - 1u) + 1u]);"},
          Planted{"alpha in place of its square", "gbdpt/reconstruct.h",
                  "(float4)(RECONSTRUCT_ALPHA * RECONSTRUCT_ALPHA, 1.0f",
                  "(float4)(RECONSTRUCT_ALPHA, 1.0f"}}) {
        SCOPED_TRACE(fault.name);
        const ocl::Program program = program_of(device, plant(fault).string());
        EXPECT_GT(largest_difference(sums.picture(device, program, Reconstruction::l2), exact), 1e-2);
    }
}

/// What a render of this seed says, of the first colour.
std::vector<double> rendered(const ocl::Device& device, Aov aov, Reconstruction method) {
    RenderJob job;
    job.size = {32, 32};
    job.spp = 5;
    job.path_length = 4;
    job.aov = aov;
    job.variant.reconstruction = method;
    const Image image = render_film(device, "gbdpt", shipped_scene("thesis"), job).mean;
    std::vector<double> red;
    for (std::size_t i = 0; i < image.rgb.size(); i += 3) red.push_back(image.rgb[i]);
    return red;
}

TEST(Reconstruction, a_picture_is_made_of_what_is_shown_beside_it) {
    on_every_device([&](const ocl::Device& device) {
        const auto l2 = Reconstruction::l2;
        const Differences shown{{32, 32},
                                rendered(device, Aov::primal, l2),
                                rendered(device, Aov::dx, l2),
                                rendered(device, Aov::dy, l2)};
        const std::vector<double> picture = rendered(device, Aov::radiance, l2);
        double brightness = 0;
        for (const double value : shown.pixels)
            brightness += value / static_cast<double>(shown.pixels.size());
        const std::vector<double> exact = least_squares(shown, alpha);
        // What the turns leave: 4e-4 in all, 1.3e-3 where it is most.
        EXPECT_LT(root_mean_square(picture, exact), 1e-3 * brightness);
        EXPECT_LT(largest_difference(picture, exact), 5e-3 * brightness);
        EXPECT_GT(largest_difference(picture, shown.pixels), 0.1 * brightness);
        EXPECT_EQ(rendered(device, Aov::radiance, Reconstruction::none), shown.pixels);
    });
}

}  // namespace
}  // namespace ptb
