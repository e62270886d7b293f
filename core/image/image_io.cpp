#include "core/image/image_io.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <iterator>
#include <memory>

#include <fmt/format.h>
#include <png.h>

#include "core/file/replace_file.h"
#include "core/input/printable.h"

namespace ptb {
namespace {

constexpr png_uint_32 most_pixels_a_side = 8192;

std::vector<std::uint8_t> encoded_bytes(const Image& image) {
    std::vector<std::uint8_t> bytes;
    for (const float value : image.rgb) bytes.push_back(encoded(value));
    return bytes;
}

/// A comment ends with its line.
std::string ppm_text(const Image& image, const ImageNotes& notes) {
    std::string text = "P3\n";
    for (const auto& [name, note] : notes) text += fmt::format("# {} {}\n", name, printable(note));
    text += fmt::format("{} {}\n255\n", image.size.width, image.size.height);
    const std::vector<std::uint8_t> bytes = encoded_bytes(image);
    for (std::size_t i = 0; i < bytes.size(); i += 3)
        fmt::format_to(std::back_inserter(text), "{} {} {}\n", bytes[i], bytes[i + 1], bytes[i + 2]);
    return text;
}

/// Rows from the bottom, little-endian (which the minus sign of the scale says).
std::string pfm_bytes(const Image& image, const ImageNotes&) {
    std::string bytes = fmt::format("PF\n{} {}\n-1.0\n", image.size.width, image.size.height);
    const std::size_t row = 3 * static_cast<std::size_t>(image.size.width);
    for (std::size_t y = static_cast<std::size_t>(image.size.height); y-- > 0;) {
        for (std::size_t i = y * row; i < (y + 1) * row; ++i) {
            const auto word = std::bit_cast<std::uint32_t>(image.rgb[i]);
            for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(word >> shift & 0xff);
        }
    }
    return bytes;
}

void append_png(png_structp png, png_bytep bytes, png_size_t count) {
    static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<const char*>(bytes), count);
}

[[noreturn]] void fail_png(png_structp, png_const_charp reason) { throw ImageError(reason); }

/// libpng's own structs for one file.
struct PngWriter {
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, fail_png, nullptr);
    png_infop info = png_create_info_struct(png);
    PngWriter() = default;
    ~PngWriter() { png_destroy_write_struct(&png, &info); }
    PngWriter(const PngWriter&) = delete;
    PngWriter& operator=(const PngWriter&) = delete;
};

std::vector<png_text> png_texts(const ImageNotes& notes) {
    std::vector<png_text> texts;
    for (const auto& [name, note] : notes) {
        png_text& text = texts.emplace_back();
        text.compression = PNG_TEXT_COMPRESSION_zTXt;
        text.key = const_cast<char*>(name.c_str());  // libpng only reads them
        text.text = const_cast<char*>(note.c_str());
        text.text_length = note.size();
    }
    return texts;
}

std::string png_bytes(const Image& image, const ImageNotes& notes) {
    std::string bytes;
    std::vector<std::uint8_t> rgb = encoded_bytes(image);
    const PngWriter writer;
    png_set_write_fn(writer.png, &bytes, append_png, nullptr);
    png_set_IHDR(writer.png, writer.info, static_cast<png_uint_32>(image.size.width),
                 static_cast<png_uint_32>(image.size.height), 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    const std::vector<png_text> texts = png_texts(notes);
    png_set_text(writer.png, writer.info, texts.data(), static_cast<int>(texts.size()));
    png_write_info(writer.png, writer.info);
    const std::size_t row = 3 * static_cast<std::size_t>(image.size.width);
    for (std::size_t at = 0; at < rgb.size(); at += row) png_write_row(writer.png, rgb.data() + at);
    png_write_end(writer.png, nullptr);
    return bytes;
}

float decoded(std::uint8_t byte) {
    const float root = static_cast<float>(byte) / 255;
    return root * root;
}

std::string extension_of(const std::filesystem::path& file) {
    std::string extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    return extension;
}

const std::map<std::string, std::function<std::string(const Image&, const ImageNotes&)>>& encoders() {
    static const std::map<std::string, std::function<std::string(const Image&, const ImageNotes&)>> table = {
        {".pfm", pfm_bytes}, {".png", png_bytes}, {".ppm", ppm_text}};
    return table;
}

}  // namespace

std::uint8_t encoded(float linear) {
    if (!(linear > 0)) return 0;
    return static_cast<std::uint8_t>(std::lround(255 * std::sqrt(std::min(linear, 1.0F))));
}

Image read_png(const std::filesystem::path& file) {
    png_image png = {};
    png.version = PNG_IMAGE_VERSION;
    const std::unique_ptr<png_image, decltype(&png_image_free)> freed(&png, png_image_free);
    if (!png_image_begin_read_from_file(&png, file.c_str()))
        throw ImageError(fmt::format("{}: {}", file.string(), png.message));
    if (std::max(png.width, png.height) > most_pixels_a_side)
        throw ImageError(fmt::format("{}: {} x {} pixels; allowed: {} a side", file.string(), png.width,
                                     png.height, most_pixels_a_side));
    png.format = PNG_FORMAT_RGB;
    std::vector<std::uint8_t> bytes(PNG_IMAGE_SIZE(png));
    if (!png_image_finish_read(&png, nullptr, bytes.data(), 0, nullptr))
        throw ImageError(fmt::format("{}: {}", file.string(), png.message));
    Image image{{static_cast<int>(png.width), static_cast<int>(png.height)}, {}};
    std::transform(bytes.begin(), bytes.end(), std::back_inserter(image.rgb), decoded);
    return image;
}

void write_bytes(const std::filesystem::path& file, std::string_view bytes) {
    if (const std::error_code error = replace_file(file, bytes))
        throw ImageError(fmt::format("{}: cannot be written: {}", file.string(), error.message()));
}

bool is_image_file(const std::filesystem::path& file) {
    return extension_of(file) == ".exr" || encoders().contains(extension_of(file));
}

bool keeps_floats(const std::filesystem::path& file) {
    const std::string extension = extension_of(file);
    return extension == ".exr" || extension == ".pfm";
}

void write_image(const std::filesystem::path& file, const Image& image, const ImageNotes& notes) {
    if (!is_image_file(file))
        throw ImageError(fmt::format("{}: the extension \"{}\" is not one of .exr .pfm .png .ppm",
                                     file.string(), file.extension().string()));
    if (extension_of(file) == ".exr") return write_exr_layers(file, {{"", image}}, notes);
    if (image.size.pixels() == 0 || image.rgb.size() != 3 * image.size.pixels())
        throw ImageError(file.string() + ": there is nothing to write");
    write_bytes(file, encoders().at(extension_of(file))(image, notes));
}

}  // namespace ptb
