#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <png.h>
#include <unistd.h>

#include "core/image/image_io.h"

namespace ptb {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

/// A folder of its own for each test, removed with it.
class ImageFile : public ::testing::Test {
  protected:
    ImageFile() : folder_(fs::temp_directory_path() / ("ptbench_image_" + std::to_string(getpid()))) {
        fs::create_directories(folder_);
    }
    ~ImageFile() override { fs::remove_all(folder_); }

    fs::path path(const std::string& name) const { return folder_ / name; }
    std::string bytes(const std::string& name) const {
        std::ifstream stream(path(name), std::ios::binary);
        std::ostringstream text;
        text << stream.rdbuf();
        return text.str();
    }
    std::size_t file_count() const {
        return static_cast<std::size_t>(
            std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
    }

    fs::path folder_;
};

/// Three columns and two rows; each value another one.
Image sample_image() {
    Image image = {{3, 2}, {}};
    for (int i = 0; i < 18; ++i) image.rgb.push_back(0.1F * static_cast<float>(i) - 0.2F);
    return image;
}

std::string error_of(const std::function<void()>& action) {
    try {
        action();
    } catch (const ImageError& error) {
        return error.what();
    }
    return "no error";
}

TEST_F(ImageFile, extensions_are_known_in_any_case) {
    for (const char* name : {"a.exr", "a.PFM", "b/c.Png", "x.y.ppm"})
        EXPECT_TRUE(is_image_file(name)) << name;
    for (const char* name : {"a", "exr", "a.jpg", "a.exr.gz", ".png"})
        EXPECT_FALSE(is_image_file(name)) << name;
}

TEST_F(ImageFile, exr_keeps_every_bit) {
    Image image = sample_image();
    image.rgb[4] = 1e30F;
    image.rgb[5] = 1e-40F;
    image.rgb[6] = std::numeric_limits<float>::infinity();
    write_image(path("a.exr"), image);
    EXPECT_EQ(read_exr_layers(path("a.exr")).at(""), image);
}

TEST_F(ImageFile, exr_layers_come_back_by_name) {
    Image other = sample_image();
    for (float& value : other.rgb) value *= 7;
    const std::map<std::string, Image> layers = {{"mean", sample_image()}, {"variance", other}, {"", other}};
    write_exr_layers(path("a.exr"), layers);
    EXPECT_EQ(read_exr_layers(path("a.exr")), layers);
}

TEST_F(ImageFile, exr_layers_of_two_sizes_are_refused) {
    const Image small = {{1, 1}, {1, 2, 3}};
    EXPECT_THAT(error_of([&] {
                    write_exr_layers(path("a.exr"), {{"a", sample_image()}, {"b", small}});
                }),
                AllOf(StartsWith(path("a.exr").string()), HasSubstr("\"b\"")));
    EXPECT_THAT(error_of([&] { write_exr_layers(path("a.exr"), {}); }), HasSubstr("nothing to write"));
    EXPECT_EQ(file_count(), 0U);
}

TEST_F(ImageFile, damaged_exr_files_are_errors) {
    Image image = {{64, 64}, std::vector<float>(3 * 64 * 64)};
    for (std::size_t i = 0; i < image.rgb.size(); ++i) image.rgb[i] = std::sin(static_cast<float>(i));
    write_image(path("a.exr"), image);
    const std::string whole = bytes("a.exr");
    for (const std::size_t length : {std::size_t{0}, std::size_t{4}, std::size_t{100}, whole.size() / 2}) {
        std::ofstream(path("cut.exr"), std::ios::binary) << whole.substr(0, length);
        EXPECT_THAT(error_of([&] { read_exr_layers(path("cut.exr")); }),
                    StartsWith(path("cut.exr").string() + ": cannot be read: "))
            << length;
    }
    EXPECT_THAT(error_of([&] { read_exr_layers(path("none.exr")); }), HasSubstr("cannot be read"));
}

TEST_F(ImageFile, ppm_is_text_with_square_roots_clamped_to_bytes) {
    const Image image = {{2, 1}, {0, 0.25F, 1, 2, -1, std::nanf("")}};
    write_image(path("a.ppm"), image);
    EXPECT_EQ(bytes("a.ppm"), "P3\n2 1\n255\n0 128 255\n255 0 0\n");
}

TEST_F(ImageFile, png_decodes_to_the_same_bytes_as_ppm) {
    const Image image = {{2, 1}, {0, 0.25F, 1, 2, -1, std::nanf("")}};
    write_image(path("a.png"), image);
    png_image png = {};
    png.version = PNG_IMAGE_VERSION;
    ASSERT_TRUE(png_image_begin_read_from_file(&png, path("a.png").c_str()));
    png.format = PNG_FORMAT_RGB;
    ASSERT_EQ(PNG_IMAGE_SIZE(png), 6U);
    std::vector<std::uint8_t> rgb(6);
    ASSERT_TRUE(png_image_finish_read(&png, nullptr, rgb.data(), 0, nullptr));
    EXPECT_THAT(rgb, ::testing::ElementsAre(0, 128, 255, 255, 0, 0));
}

TEST_F(ImageFile, notes_stand_in_the_file) {
    const Image image{{1, 1}, {0.5f, 0.25f, 1}};
    const ImageNotes notes{{"ptbench.ranges", "{\"parts\":[[0,10]]}"}};
    write_image(path("x.ppm"), image, notes);
    EXPECT_THAT(bytes("x.ppm"), StartsWith("P3\n# ptbench.ranges {\"parts\":[[0,10]]}\n1 1\n255\n"));
    write_image(path("x.exr"), image, notes);
    EXPECT_THAT(bytes("x.exr"), HasSubstr("{\"parts\":[[0,10]]}"));
    EXPECT_EQ(read_exr_layers(path("x.exr")).at("").rgb, image.rgb);
    write_image(path("x.png"), image, notes);
    EXPECT_THAT(bytes("x.png"), HasSubstr("zTXtptbench.ranges"));
    EXPECT_EQ(read_png(path("x.png")).rgb.size(), 3u);
}

TEST_F(ImageFile, pfm_rows_run_from_the_bottom_in_little_endian) {
    const Image image = {{1, 2}, {1, 2, 3, 4, 5, 6}};
    write_image(path("a.pfm"), image);
    const std::string header = "PF\n1 2\n-1.0\n";
    const std::string file = bytes("a.pfm");
    ASSERT_EQ(file.size(), header.size() + 24);
    EXPECT_THAT(file, StartsWith(header));
    EXPECT_EQ(file.substr(header.size(), 4), std::string("\0\0\x80\x40", 4));       // 4.0F
    EXPECT_EQ(file.substr(header.size() + 12, 4), std::string("\0\0\x80\x3f", 4));  // 1.0F
}

TEST_F(ImageFile, an_unknown_extension_names_the_known_ones) {
    EXPECT_THAT(error_of([&] { write_image(path("a.jpg"), sample_image()); }),
                HasSubstr(".exr .pfm .png .ppm"));
}

TEST_F(ImageFile, a_file_that_cannot_be_written_is_named_and_leaves_nothing) {
    for (const char* extension : {".exr", ".pfm", ".png", ".ppm"}) {
        const fs::path file = path("none") / (std::string("a") + extension);
        EXPECT_THAT(error_of([&] { write_image(file, sample_image()); }),
                    AllOf(StartsWith(file.string() + ": cannot be written: "), HasSubstr("No such file")));
    }
    fs::create_directories(path("folder.png") / "in_use");
    EXPECT_THAT(error_of([&] { write_image(path("folder.png"), sample_image()); }),
                HasSubstr("cannot be written"));
    EXPECT_EQ(file_count(), 1U) << "a temporary file was left behind";
}

TEST_F(ImageFile, an_empty_image_is_refused) {
    for (const char* name : {"a.exr", "a.pfm", "a.png", "a.ppm"})
        EXPECT_THAT(error_of([&] { write_image(path(name), {}); }), StartsWith(path(name).string()));
}

TEST_F(ImageFile, writing_again_replaces_the_file) {
    write_image(path("a.exr"), {{1, 1}, {1, 2, 3}});
    write_image(path("a.exr"), sample_image());
    EXPECT_EQ(read_exr_layers(path("a.exr")).at(""), sample_image());
    EXPECT_EQ(file_count(), 1U);
}

TEST_F(ImageFile, a_png_comes_back_as_near_as_8_bits_allow) {
    write_image(path("a.png"), sample_image());
    const Image read = read_png(path("a.png"));
    ASSERT_EQ(read.size, sample_image().size);
    for (std::size_t i = 0; i < 18; ++i)
        EXPECT_NEAR(read.rgb[i], std::clamp(sample_image().rgb[i], 0.0F, 1.0F), 1.0 / 255) << i;
}

TEST_F(ImageFile, what_is_no_png_is_refused_with_its_name) {
    std::ofstream(path("bad.png")) << "not a picture";
    EXPECT_THAT(error_of([&] { read_png(path("bad.png")); }), HasSubstr("bad.png: "));
    EXPECT_THAT(error_of([&] { read_png(path("none.png")); }), HasSubstr("none.png: "));
}

}  // namespace
}  // namespace ptb
