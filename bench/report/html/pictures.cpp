#include "bench/report/html/pictures.h"

#include <algorithm>
#include <memory>
#include <set>

#include <fmt/format.h>
#include <webp/encode.h>

#include "bench/plan/config.h"
#include "bench/record/status.h"
#include "bench/report/words.h"
#include "bench/validate/blocks.h"
#include "bench/validate/validate.h"
#include "core/image/image_io.h"
#include "core/integrator/registry.h"

namespace ptb {
namespace {

namespace fs = std::filesystem;

constexpr int most_pixels_a_side = 256;
constexpr float quality = 88;

/// As it is, or averaged until a page can have several of it.
Image small(const Image& image) {
    const int longer = std::max(image.size.width, image.size.height);
    const int edge = (longer + most_pixels_a_side - 1) / most_pixels_a_side;
    const Blocks blocks = block_means(image, edge);
    return {{blocks.across, blocks.down}, {blocks.rgb.begin(), blocks.rgb.end()}};
}

std::string webp(const Image& image) {
    std::vector<std::uint8_t> rgb;
    std::transform(image.rgb.begin(), image.rgb.end(), std::back_inserter(rgb), encoded);
    std::uint8_t* bytes = nullptr;
    const std::size_t size =
        WebPEncodeRGB(rgb.data(), image.size.width, image.size.height, 3 * image.size.width, quality, &bytes);
    const std::unique_ptr<std::uint8_t, decltype(&WebPFree)> freed(bytes, WebPFree);
    return {reinterpret_cast<const char*>(bytes), size};
}

/// A page says nothing of where files lie on the machine that made it.
std::string without(const std::string& text, const std::string& folder) {
    return text.starts_with(folder) ? text.substr(folder.size()) : text;
}

bool is_plain_name(const std::string& name) { return !name.empty() && fs::path(name).filename() == name; }

std::string status_of(const ResultFile& result, const Case& c) {
    for (const Record& record : result.cases)
        if (record.params == c && record.status != Status::ok)
            return fmt::format(", {}: {}", to_string(record.status), record.reason);
    return "";
}

std::string caption_of(const ResultFile& result, const Picture& picture) {
    const Case& c = picture.params;
    return fmt::format("{}: {}, {}, {} samples per pixel{}", device_label(result, c.device), c.kernel,
                       to_string(c.size), c.spp, status_of(result, c));
}

std::optional<Reference> reference_of(const Case& c, const fs::path& folder) {
    if (!is_plain_name(c.scene) || !is_plain_name(c.kernel)) return std::nullopt;
    return load_reference(folder,
                          reference_name(c.scene, truth_of(c.kernel), validation_size, c.path_length));
}

Figure z_figure(const Image& image, const Reference& reference, const Picture& picture) {
    const auto map = z_map(image, reference, picture.params.spp);
    if (!map)
        return {fmt::format("{}: no z-map; its size is no multiple of the reference's", picture.file), ""};
    return {fmt::format(
                "z-map of {}: white agrees with the reference, red is brighter, blue darker, full colour is "
                "5 standard errors; root mean square {:.2f} (noise alone: about 1), {:.2g} % beyond 4",
                picture.file, map->rms, 100 * map->beyond_4),
            webp(map->image)};
}

/// Appends what there is to see of one picture; `shown` are the references that are there already.
void append(std::vector<Figure>& all, const ResultFile& result, const Picture& picture,
            const fs::path& folder, const fs::path& references, std::set<std::string>& shown) {
    const Image image = read_png(folder / picture.file);
    const auto reference = reference_of(picture.params, references);
    const Case& c = picture.params;
    const std::string truth =
        fmt::format("{}, {}, path length {}", c.scene, truth_of(c.kernel), c.path_length);
    if (reference && shown.insert(truth).second)
        all.push_back({fmt::format("reference: {}, {} samples per pixel on the host", truth, reference->spp),
                       webp(small(reference->mean))});
    all.push_back({caption_of(result, picture), webp(small(image))});
    if (reference)
        all.push_back(z_figure(image, *reference, picture));
    else
        all.push_back({fmt::format("{}: there is no reference of {}", picture.file, truth), ""});
}

}  // namespace

std::vector<Figure> figures(const ResultFile& result, const fs::path& folder, const fs::path& references) {
    std::vector<Figure> all;
    std::set<std::string> shown;
    for (const Picture& picture : result.pictures) {
        try {
            if (!is_plain_name(picture.file))
                throw ImageError(picture.file + ": not a name beside the result");
            append(all, result, picture, folder, references, shown);
        } catch (const ImageError& error) {
            const std::string why = without(error.what(), (folder / "").string());
            all.push_back({fmt::format("{}: no picture: {}", caption_of(result, picture), why), ""});
        }
    }
    return all;
}

}  // namespace ptb
