#include "bench/report/html/pictures.h"

#include <algorithm>
#include <memory>
#include <set>

#include <fmt/format.h>
#include <webp/encode.h>

#include "bench/plan/config.h"
#include "bench/record/fingerprint.h"
#include "bench/record/status.h"
#include "bench/report/ladder.h"
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

const Record* record_of(const ResultFile& result, const Case& c) {
    for (const Record& record : result.cases)
        if (record.params == c) return &record;
    return nullptr;
}

/// ", 512 ms, relMSE 0.118"
std::string worth_of(const ResultFile& result, const Case& c) {
    const Record* const record = record_of(result, c);
    if (record == nullptr || !timed(*record) || !record->efficiency || !record->efficiency->all) return "";
    return fmt::format(", {} ms, relMSE {}", number_text(ms(record->statistics->median_ns)),
                       number_text(record->efficiency->all->rel_mse));
}

std::string caption_of(const ResultFile& result, const Picture& picture) {
    const Case& c = picture.params;
    return fmt::format("{}: {}, {}, {} samples per pixel{}{}", device_label(result, c.device), c.kernel,
                       to_string(c.size), c.spp, worth_of(result, c), status_of(result, c));
}

/// Of the scene as the run had it.
std::optional<Reference> reference_of(const ResultFile& result, const Case& c, const fs::path& folder) {
    if (!is_plain_name(c.scene) || !is_plain_name(c.kernel)) return std::nullopt;
    const std::string name = reference_name(c.scene, truth_of(c.kernel), validation_size, c.path_length);
    return load_reference(folder, name, scene_hash_of(result.run, c.scene));
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

/// What there is to see of one picture.
struct Seen {
    std::vector<Figure> reference;  ///< none if it is shown already
    Figure picture, z_map;
};

/// `shown` are the references that are there already.
Seen seen(const ResultFile& result, const Picture& picture, const fs::path& folder,
          const fs::path& references, std::set<std::string>& shown) {
    const Image image = read_png(folder / picture.file);
    const auto reference = reference_of(result, picture.params, references);
    const Case& c = picture.params;
    const std::string truth =
        fmt::format("{}, {}, path length {}", c.scene, truth_of(c.kernel), c.path_length);
    Seen all;
    if (reference && shown.insert(truth).second)
        all.reference.push_back(
            {fmt::format("reference: {}, {} samples per pixel on the host", truth, reference->spp),
             webp(small(reference->mean))});
    all.picture = {caption_of(result, picture), webp(small(image))};
    all.z_map = reference ? z_figure(image, *reference, picture)
                          : Figure{fmt::format("{}: there is no reference of {}", picture.file, truth), ""};
    return all;
}

/// Or why there is none.
Seen seen_if_any(const ResultFile& result, const Picture& picture, const fs::path& folder,
                 const fs::path& references, std::set<std::string>& shown) {
    try {
        if (!is_plain_name(picture.file)) throw ImageError(picture.file + ": not a name beside the result");
        return seen(result, picture, folder, references, shown);
    } catch (const ImageError& error) {
        const std::string why = without(error.what(), (folder / "").string());
        return {{}, {fmt::format("{}: no picture: {}", caption_of(result, picture), why), ""}, {}};
    }
}

void append(std::vector<Figure>& all, const std::vector<Figure>& figures) {
    for (const Figure& figure : figures)
        if (!figure.caption.empty()) all.push_back(figure);
}

/// Those of a result whose cases make one work in about the same time.
struct Group {
    std::string title;
    std::vector<Picture> pictures;
};

std::string variant_text(const Case& c) {
    const std::string variant = to_string(c.variant);
    return variant.empty() ? "" : ", " + variant;
}

std::string title_of(const ResultFile& result, const Ladder& ladder) {
    const Case& c = ladder.work;
    return fmt::format("{} at {}, path length {}{}, on {}: in about {} ms", c.scene, to_string(c.size),
                       c.path_length, variant_text(c), device_label(result, c.device),
                       number_text(ms(ladder.time_ns)));
}

std::vector<Group> groups_of(const ResultFile& result) {
    std::vector<Group> groups;
    for (const Ladder& ladder : ladders(result.cases)) {
        Group group{title_of(result, ladder), {}};
        for (const Picture& picture : result.pictures)
            for (const std::size_t i : ladder.cases)
                if (result.cases[i].params == picture.params) group.pictures.push_back(picture);
        if (group.pictures.size() > 1) groups.push_back(group);
    }
    return groups;
}

/// Pictures beside one another, then what they should be, and how far they are from it.
void append(std::vector<Figure>& all, const std::vector<Seen>& group, const std::string& title) {
    const std::size_t before = all.size();
    for (const Seen& each : group) append(all, {each.picture});
    for (const Seen& each : group) append(all, each.reference);
    for (const Seen& each : group) append(all, {each.z_map});
    for (std::size_t i = before; i < all.size(); ++i) all[i].group = title;
}

}  // namespace

std::vector<Figure> figures(const ResultFile& result, const fs::path& folder, const fs::path& references) {
    std::vector<Figure> all, grouped;
    std::vector<Picture> alone = result.pictures;
    for (const Group& group : groups_of(result)) {
        std::set<std::string> shown;
        std::vector<Seen> together;
        for (const Picture& picture : group.pictures) {
            together.push_back(seen_if_any(result, picture, folder, references, shown));
            std::erase(alone, picture);
        }
        append(grouped, together, group.title);
    }
    std::set<std::string> shown;
    for (const Picture& picture : alone) {
        const Seen each = seen_if_any(result, picture, folder, references, shown);
        append(all, each.reference);
        append(all, {each.picture, each.z_map});
    }
    all.insert(all.end(), grouped.begin(), grouped.end());
    return all;
}

}  // namespace ptb
