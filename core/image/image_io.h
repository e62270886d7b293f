#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>

#include "core/image/image.h"

namespace ptb {

/// An image that could not be read or written; one line with the file and the reason.
struct ImageError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// True when `write_image` knows the extension (.exr .pfm .png .ppm, in any case).
bool is_image_file(const std::filesystem::path& file);

/// Of those, whether it holds numbers of any size (.exr .pfm) and not colours.
bool keeps_floats(const std::filesystem::path& file);

/// Writes the whole file or nothing. Throws ImageError.
void write_bytes(const std::filesystem::path& file, std::string_view bytes);

/// What a picture's file says beside its pixels, by names.
using ImageNotes = std::map<std::string, std::string>;

/// Writes by extension: .exr and .pfm keep linear floats; .png (8 bit) and .ppm (P3, as the thesis wrote) are
/// clamped to [0, 1] and square-root encoded (gamma 2). Notes are attributes of .exr, text of .png, comments
/// of .ppm; .pfm has no place for any. Throws ImageError.
void write_image(const std::filesystem::path& file, const Image& image, const ImageNotes& notes = {});

/// Reads a PNG as `write_image` writes one, back to linear values. Throws ImageError, also for one of more
/// than 8192 pixels a side.
Image read_png(const std::filesystem::path& file);

/// `linear` square-root encoded (gamma 2, as the thesis wrote its pictures) to 0..255; what is no number is
/// black.
std::uint8_t encoded(float linear);

/// Several images of one size as named layers of one OpenEXR file ("mean" gives channels mean.R, mean.G,
/// mean.B).
void write_exr_layers(const std::filesystem::path& file, const std::map<std::string, Image>& layers,
                      const ImageNotes& notes = {});

/// The layers of an OpenEXR file; plain R, G, B channels are the layer "". Throws ImageError.
std::map<std::string, Image> read_exr_layers(const std::filesystem::path& file);

}  // namespace ptb
