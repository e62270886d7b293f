#include "core/oracle/reference.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "core/image/image_io.h"
#include "core/scene/content.h"

namespace ptb {
namespace {

const std::filesystem::path root = PTB_SOURCE_DIR;

/// Of a shipped scene as it is now.
Reference stored(const std::string& name) {
    const std::string scene = name.substr(0, name.substr(0, name.rfind("_128x128")).rfind('_'));
    return load_reference(root / "results/references", name,
                          scene_hash(root / "configs/scenes" / (scene + ".json")))
        .value();
}

nlohmann::json figures(const std::string& file) {
    std::ifstream stream(root / "tests/data" / file);
    return nlohmann::json::parse(stream);
}

/// Mean of a block of pixels and its standard error.
struct Estimate {
    double mean = 0, standard_error = 0;
};

Estimate block_estimate(const Reference& reference, std::size_t side, std::size_t column, std::size_t row,
                        std::size_t channel) {
    const auto width = static_cast<std::size_t>(reference.size.width);
    double sum = 0, variance = 0;
    for (std::size_t y = row * side; y < (row + 1) * side; ++y) {
        for (std::size_t x = column * side; x < (column + 1) * side; ++x) {
            const std::size_t i = 3 * (y * width + x) + channel;
            sum += static_cast<double>(reference.mean.rgb[i]);
            variance += static_cast<double>(reference.variance.rgb[i]) / reference.spp;
        }
    }
    const auto pixels = static_cast<double>(side * side);
    return {sum / pixels, std::sqrt(variance) / pixels};
}

Estimate image_estimate(const Reference& reference, std::size_t channel) {
    return block_estimate(reference, static_cast<std::size_t>(reference.size.width), 0, 0, channel);
}

/// How far two estimates are apart in standard errors; the figures have six decimals.
double z_score(const Estimate& a, const Estimate& b) {
    return (a.mean - b.mean) / std::hypot(a.standard_error, b.standard_error, 3e-7);
}

std::vector<double> block_z_scores(const Reference& reference, const nlohmann::json& truth) {
    const auto blocks = truth.at("size").get<std::size_t>() / truth.at("block").get<std::size_t>();
    const std::size_t side = static_cast<std::size_t>(reference.size.width) / blocks;
    std::vector<double> scores;
    for (std::size_t row = 0; row < blocks; ++row) {
        for (std::size_t column = 0; column < blocks; ++column) {
            for (std::size_t channel = 0; channel < 3; ++channel) {
                const Estimate theirs = {truth.at("mean")[row][column][channel],
                                         truth.at("standard_error")[row][column][channel]};
                const Estimate ours = block_estimate(reference, side, column, row, channel);
                if (ours.standard_error > 0 || theirs.standard_error > 0)
                    scores.push_back(z_score(ours, theirs));
                else
                    EXPECT_EQ(ours.mean, theirs.mean);
            }
        }
    }
    return scores;
}

/// The scores must look like draws from a unit Gaussian: a wrong block shows in the largest, a tracer that is
/// wrong a little everywhere in their root mean square.
void expect_gaussian(const std::vector<double>& scores) {
    double squares = 0, largest = 0;
    for (const double z : scores) {
        squares += z * z;
        largest = std::max(largest, std::abs(z));
    }
    const double rms = std::sqrt(squares / static_cast<double>(scores.size()));
    ::testing::Test::RecordProperty("z_rms", std::to_string(rms));
    ::testing::Test::RecordProperty("z_largest", std::to_string(largest));
    EXPECT_GT(rms, 0.85);
    EXPECT_LT(rms, 1.15);
    EXPECT_LT(largest, 5);
}

void expect_same_image_mean(const Reference& reference, const nlohmann::json& truth) {
    for (std::size_t channel = 0; channel < 3; ++channel) {
        const Estimate theirs = {truth.at("image_mean")[channel],
                                 truth.at("image_mean_standard_error")[channel]};
        const double z = z_score(image_estimate(reference, channel), theirs);
        ::testing::Test::RecordProperty("image_z_" + std::to_string(channel), std::to_string(z));
        EXPECT_LT(std::abs(z), 4) << "channel " << channel;
    }
}

TEST(StoredReference, thesis_scene_agrees_with_an_independent_tracer) {
    const nlohmann::json truth = figures("thesis_128_pl128_blocks.json");
    const Reference reference = stored("thesis_pt_128x128_pl128");
    expect_same_image_mean(reference, truth);
    expect_gaussian(block_z_scores(reference, truth));
}

TEST(StoredReference, free_light_scene_agrees_with_mitsuba) {
    const nlohmann::json truth = figures("free_light_64_pl128_mitsuba_blocks.json");
    const Reference reference = stored("free_light_pt_128x128_pl128");
    expect_same_image_mean(reference, truth);
    expect_gaussian(block_z_scores(reference, truth));
}

TEST(StoredReference, paths_have_the_true_number_of_segments) {
    // 37 to 39 would be paths lost inside a wall, of which the picture shows next to nothing.
    const Reference reference = stored("thesis_pt_128x128_pl128");
    EXPECT_NEAR(reference.segments_per_sample, 30.870303, 0.005 * 30.87);
}

TEST(StoredReference, per_sample_variance_agrees_with_an_independent_tracer) {
    const nlohmann::json truth = figures("thesis_128_pl128_blocks.json").at("mean_per_sample_variance");
    const Reference reference = stored("thesis_pt_128x128_pl128");
    double sum[3] = {};
    for (std::size_t i = 0; i < reference.variance.rgb.size(); ++i)
        sum[i % 3] += static_cast<double>(reference.variance.rgb[i]);
    for (std::size_t channel = 0; channel < 3; ++channel) {
        const double mean = sum[channel] / static_cast<double>(reference.size.pixels());
        EXPECT_NEAR(mean, truth[channel].get<double>(), 0.01 * mean);
    }
}

TEST(StoredReference, every_one_is_of_its_scene_and_named_by_what_it_holds) {
    int count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(root / "results/references")) {
        if (entry.path().extension() != ".json") continue;
        ++count;
        SCOPED_TRACE(entry.path());
        const Reference reference = stored(entry.path().stem().string());
        EXPECT_EQ(entry.path().stem().string(),
                  reference_name(reference.scene, reference.kernel, reference.size, reference.path_length));
        EXPECT_LE(std::filesystem::file_size(entry.path().parent_path() / (entry.path().stem() += ".exr")),
                  500'000U);
        for (const Image* image : {&reference.mean, &reference.variance}) {
            for (const float value : image->rgb)
                ASSERT_TRUE(std::isfinite(value) && value >= 0) << entry.path();
        }
    }
    EXPECT_EQ(count, 48);
}

TEST(StoredReference, furnace_has_its_closed_form) {
    const double albedo[] = {0.5, 0.7, 0.9};  // of configs/scenes/furnace.json
    for (const int path_length : {5, 128}) {
        const Reference reference = stored("furnace_pt_128x128_pl" + std::to_string(path_length));
        EXPECT_EQ(reference.segments_per_sample, path_length);
        EXPECT_EQ(reference.segments_variance, 0);
        EXPECT_EQ(reference.full_length_share, 1);
        for (std::size_t i = 0; i < reference.mean.rgb.size(); ++i) {
            const double a = albedo[i % 3];
            EXPECT_FLOAT_EQ(reference.mean.rgb[i],
                            static_cast<float>((1 - std::pow(a, path_length)) / (1 - a)));
            EXPECT_EQ(reference.variance.rgb[i], 0);
        }
    }
}

TEST(StoredReference, furnace_has_its_light_once_or_lit_once) {
    const float albedo[] = {0.5F, 0.7F, 0.9F};  // of configs/scenes/furnace.json
    const Reference whitted = stored("furnace_whitted_128x128_pl5");
    const Reference direct = stored("furnace_direct_128x128_pl5");
    for (std::size_t i = 0; i < direct.mean.rgb.size(); ++i) {
        EXPECT_FLOAT_EQ(whitted.mean.rgb[i], 1);
        EXPECT_FLOAT_EQ(direct.mean.rgb[i], 1 + albedo[i % 3]);
        EXPECT_EQ(direct.variance.rgb[i], 0);
    }
}

/// Scenes and path lengths of the references of `direct` and `whitted`.
const std::vector<std::pair<std::string, std::string>> lit = {
    {"thesis", "5"}, {"thesis", "128"}, {"free_light", "5"}, {"free_light", "128"},
    {"lamps", "5"},  {"lamps", "128"},  {"cornell", "10"},   {"knot", "10"}};

TEST(StoredReference, whitted_and_direct_have_the_same_paths) {
    for (const auto& [scene, length] : lit) {
        const Reference a = stored(scene + "_whitted_128x128_pl" + length);
        const Reference b = stored(scene + "_direct_128x128_pl" + length);
        const auto deviation = [](const Reference& reference, double variance) {
            return std::sqrt(variance / static_cast<double>(reference.size.pixels()) / reference.spp);
        };
        const double z_segments = z_score({a.segments_per_sample, deviation(a, a.segments_variance)},
                                          {b.segments_per_sample, deviation(b, b.segments_variance)});
        EXPECT_LT(std::abs(z_segments), 4) << scene << ", " << length;
        const double share = b.full_length_share;
        const double z_share = z_score({a.full_length_share, deviation(a, share * (1 - share))},
                                       {share, deviation(b, share * (1 - share))});
        EXPECT_LT(std::abs(z_share), 4) << scene << ", " << length;
    }
}

TEST(StoredReference, direct_is_nowhere_brighter_than_pt_and_darker_on_the_whole) {
    for (const auto& [scene, length] : lit) {
        const Reference direct = stored(scene + "_direct_128x128_pl" + length);
        const Reference pt = stored(scene + "_pt_128x128_pl" + length);
        for (std::size_t block = 0; block < 8 * 8 * 3; ++block) {
            const std::size_t column = block / 3 % 8, row = block / 24, channel = block % 3;
            const double z = z_score(block_estimate(direct, 16, column, row, channel),
                                     block_estimate(pt, 16, column, row, channel));
            EXPECT_LT(z, 4.5) << scene << ", " << length << ", block " << column << ", " << row;
        }
        EXPECT_LT(z_score(image_estimate(direct, 0), image_estimate(pt, 0)), -20) << scene;
    }
}

/// A folder of its own, removed with the test.
class ReferenceFiles : public ::testing::Test {
  protected:
    ReferenceFiles()
        : folder_(std::filesystem::temp_directory_path() / ("ptbench_ref_" + std::to_string(getpid()))) {
        std::filesystem::create_directories(folder_);
    }
    ~ReferenceFiles() override { std::filesystem::remove_all(folder_); }

    std::optional<Reference> read(const std::string& name) const {
        return load_reference(folder_, name, sample_.scene_content);
    }

    std::filesystem::path folder_;
    Reference sample_ = {.scene = "s",
                         .kernel = "pt",
                         .scene_content = "9f86d081884c7d65",
                         .size = {2, 1},
                         .path_length = 7,
                         .spp = 3,
                         .segments_per_sample = 2.5,
                         .segments_variance = 0.1,
                         .full_length_share = 0.25,
                         .made_by = "by hand",
                         .mean = {{2, 1}, {0, 1, 2, 3, 4, 0.1F}},
                         .variance = {{2, 1}, {0, 1e-30F, 0.1F, 1e9F, 4, 0}}};
};

TEST_F(ReferenceFiles, come_back_as_they_were_saved) {
    save_reference(folder_, sample_);
    const Reference saved = read("s_pt_2x1_pl7").value();
    EXPECT_EQ(saved.scene, "s");
    EXPECT_EQ(saved.kernel, "pt");
    EXPECT_EQ(saved.scene_content, "9f86d081884c7d65");
    EXPECT_EQ(saved.size, (Size{2, 1}));
    EXPECT_EQ(saved.path_length, 7);
    EXPECT_EQ(saved.spp, 3);
    EXPECT_EQ(saved.segments_per_sample, 2.5);
    EXPECT_EQ(saved.segments_variance, 0.1);
    EXPECT_EQ(saved.full_length_share, 0.25);
    EXPECT_EQ(saved.made_by, "by hand");
    EXPECT_EQ(saved.mean, sample_.mean);
}

TEST_F(ReferenceFiles, variance_loses_digits_but_zero_stays_the_only_zero) {
    save_reference(folder_, sample_);
    const Image saved = read("s_pt_2x1_pl7").value().variance;
    for (std::size_t i = 0; i < saved.rgb.size(); ++i) {
        const float truth = sample_.variance.rgb[i];
        EXPECT_NEAR(saved.rgb[i], truth, 0.0005F * truth);
        EXPECT_EQ(saved.rgb[i] == 0, truth == 0);
    }
}

TEST_F(ReferenceFiles, none_is_no_error_but_half_of_one_is) {
    EXPECT_FALSE(read("s_pt_2x1_pl7").has_value());
    save_reference(folder_, sample_);
    std::filesystem::remove(folder_ / "s_pt_2x1_pl7.exr");
    EXPECT_THROW(read("s_pt_2x1_pl7"), ImageError);
    save_reference(folder_, sample_);
    std::filesystem::remove(folder_ / "s_pt_2x1_pl7.json");
    EXPECT_THROW(read("s_pt_2x1_pl7"), ImageError);
}

TEST_F(ReferenceFiles, that_of_another_scene_of_the_name_is_none) {
    save_reference(folder_, sample_);
    EXPECT_FALSE(load_reference(folder_, "s_pt_2x1_pl7", "another").has_value());
}

TEST_F(ReferenceFiles, contradictions_are_errors) {
    save_reference(folder_, sample_);
    for (const char* text : {"{", "{}", "[1]", R"({"scene": 1})"}) {
        std::ofstream(folder_ / "s_pt_2x1_pl7.json") << text;
        EXPECT_THROW(read("s_pt_2x1_pl7"), ImageError) << text;
    }
    sample_.size = {1, 1};  // the picture has two pixels
    EXPECT_THROW(
        {
            save_reference(folder_, sample_);
            read("s_pt_1x1_pl7");
        },
        ImageError);
    sample_.size = {2, 1};
    sample_.spp = 0;
    save_reference(folder_, sample_);
    EXPECT_THROW(read("s_pt_2x1_pl7"), ImageError);
}

}  // namespace
}  // namespace ptb
