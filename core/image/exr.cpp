#include <exception>
#include <sstream>

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfStdIO.h>
#include <ImfStringAttribute.h>
#include <fmt/format.h>

#include "core/image/image_io.h"

namespace ptb {
namespace {

constexpr const char* channel_names[] = {"R", "G", "B"};
constexpr std::size_t most_pixels = std::size_t{1} << 28;  // a damaged header must not ask for all memory

std::string channel_of(const std::string& layer, int channel) {
    return (layer.empty() ? "" : layer + ".") + channel_names[channel];
}

/// One channel of an interleaved image whose first pixel has the file's coordinates `x` and `y`.
Imf::Slice slice(const Image& image, int channel, int x = 0, int y = 0) {
    // OpenEXR takes char* for reading and writing alike.
    auto* base = reinterpret_cast<char*>(const_cast<float*>(image.rgb.data() + channel));
    const std::size_t pixel = 3 * sizeof(float), row = pixel * static_cast<std::size_t>(image.size.width);
    base -= static_cast<std::ptrdiff_t>(pixel) * x + static_cast<std::ptrdiff_t>(row) * y;
    return {Imf::FLOAT, base, pixel, row};
}

std::string encode(const std::map<std::string, Image>& layers, const ImageNotes& notes) {
    const Size size = layers.begin()->second.size;
    Imf::Header header(size.width, size.height);
    header.compression() = Imf::ZIP_COMPRESSION;
    for (const auto& [name, text] : notes) header.insert(name, Imf::StringAttribute(text));
    Imf::FrameBuffer buffer;
    for (const auto& [layer, image] : layers) {
        for (int channel = 0; channel < 3; ++channel) {
            header.channels().insert(channel_of(layer, channel), Imf::Channel(Imf::FLOAT));
            buffer.insert(channel_of(layer, channel), slice(image, channel));
        }
    }
    Imf::StdOSStream stream;
    {
        Imf::OutputFile file(stream, header, 0);
        file.setFrameBuffer(buffer);
        file.writePixels(size.height);
    }  // writes the table of lines
    return stream.str();
}

/// The layers that a file names, empty images so far.
std::map<std::string, Image> layers_of(const Imf::Header& header) {
    const auto& window = header.dataWindow();
    const std::size_t width = static_cast<std::size_t>(std::int64_t{window.max.x} - window.min.x + 1);
    const std::size_t height = static_cast<std::size_t>(std::int64_t{window.max.y} - window.min.y + 1);
    if (width > most_pixels || height > most_pixels || width * height > most_pixels)
        throw ImageError(fmt::format("{} x {} pixels are more than are read here", width, height));
    std::map<std::string, Image> layers;
    for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel) {
        const std::string name = channel.name();
        if (name == "R") layers[""];
        if (name.size() > 2 && name.ends_with(".R")) layers[name.substr(0, name.size() - 2)];
    }
    for (auto& [name, image] : layers) {
        image.size = {static_cast<int>(width), static_cast<int>(height)};
        image.rgb.resize(3 * width * height);
    }
    if (layers.empty()) throw ImageError("it has no R, G, B channels");
    return layers;
}

std::map<std::string, Image> decode(const std::filesystem::path& path) {
    Imf::InputFile file(path.c_str(), 0);
    std::map<std::string, Image> layers = layers_of(file.header());
    const auto& window = file.header().dataWindow();
    Imf::FrameBuffer buffer;
    for (const auto& [layer, image] : layers) {
        for (int channel = 0; channel < 3; ++channel) {
            const std::string name = channel_of(layer, channel);
            if (!file.header().channels().findChannel(name)) throw ImageError("it has no channel " + name);
            buffer.insert(name, slice(image, channel, window.min.x, window.min.y));
        }
    }
    file.setFrameBuffer(buffer);
    file.readPixels(window.min.y, window.max.y);
    return layers;
}

void require_one_size(const std::filesystem::path& file, const std::map<std::string, Image>& layers) {
    for (const auto& [name, image] : layers) {
        const bool fits = image.size == layers.begin()->second.size && image.size.width > 0 &&
                          image.size.height > 0 && image.rgb.size() == 3 * image.size.pixels();
        if (!fits)
            throw ImageError(
                fmt::format("{}: layer \"{}\" differs in size or is empty", file.string(), name));
    }
    if (layers.empty()) throw ImageError(file.string() + ": there is nothing to write");
}

}  // namespace

void write_exr_layers(const std::filesystem::path& file, const std::map<std::string, Image>& layers,
                      const ImageNotes& notes) {
    require_one_size(file, layers);
    write_bytes(file, encode(layers, notes));
}

std::map<std::string, Image> read_exr_layers(const std::filesystem::path& file) {
    try {
        return decode(file);
    } catch (const std::exception& error) {
        throw ImageError(fmt::format("{}: cannot be read: {}", file.string(), error.what()));
    }
}

}  // namespace ptb
