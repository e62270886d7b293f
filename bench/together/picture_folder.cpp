#include "bench/together/picture_folder.h"

#include <algorithm>

#include <fmt/format.h>

#include "bench/record/file.h"
#include "bench/record/json.h"
#include "bench/together/hand_out.h"
#include "bench/worker/film_file.h"
#include "core/file/replace_file.h"
#include "core/input/usage_error.h"

namespace ptb {
namespace {

namespace fs = std::filesystem;

constexpr double chunk_share = 0.5;         ///< of what would be a node's share of the rest
constexpr std::uint64_t chunks_most = 128;  ///< of a node: so much of its share may one end later

Json with_nodes(const PictureRanges& ranges, std::size_t nodes) {
    Json json = parse_json(to_text(ranges), "ranges");
    json["nodes"] = nodes;
    return json;
}

/// Words of what two pictures differ in.
std::vector<std::string> differing_in(const PictureRanges& there, const PictureRanges& here) {
    RunFingerprint theirs = there.facts, mine = here.facts;
    const auto add = [&](const std::string& name, const std::string& their, const std::string& my) {
        theirs[name] = their;
        mine[name] = my;
    };
    add("case", dump_json(encode(there.params)), dump_json(encode(here.params)));
    add("seed", std::to_string(there.seed), std::to_string(here.seed));
    add("scene", there.scene_hash, here.scene_hash);
    return differences(theirs, "there", mine, "here");
}

}  // namespace

std::vector<PartRange> chunks_of(std::uint64_t parts, std::uint64_t round_parts, std::size_t nodes) {
    const std::uint64_t least = std::max<std::uint64_t>(parts / (nodes * chunks_most), 1);
    std::vector<PartRange> chunks;
    for (std::uint64_t first = 0; first < parts;) {
        const auto of_rest = static_cast<std::uint64_t>(chunk_share * static_cast<double>(parts - first) /
                                                        static_cast<double>(nodes));
        std::uint64_t end = std::min(parts, first + std::max(of_rest, least));
        if (end / round_parts * round_parts > first) end = end / round_parts * round_parts;
        chunks.push_back({first, end});
        first = end;
    }
    return chunks;
}

PictureFolder::PictureFolder(fs::path path) : path_(std::move(path)) {
    for (const char* const part : {"chunks", "films"}) {
        std::error_code error;
        fs::create_directories(path_ / part, error);
        if (error)
            throw UsageError(
                fmt::format("--fleet: cannot create {}: {}", (path_ / part).string(), error.message()));
    }
}

fs::path PictureFolder::chunk(std::size_t number) const {
    return path_ / "chunks" / fmt::format("{:06}", number);
}

std::optional<PictureRanges> PictureFolder::begun() const {
    std::error_code ignored;
    if (!fs::exists(plan(), ignored)) return std::nullopt;
    return parse_picture_plan(read_text(plan()), plan().string());
}

PictureRanges PictureFolder::join(const PictureRanges& mine, std::size_t nodes,
                                  std::vector<std::string>& differing) {
    const std::error_code error = make_new_file(plan(), dump_json(with_nodes(mine, nodes)) + "\n");
    if (error && error != std::errc::file_exists)
        throw std::runtime_error(fmt::format("cannot write {}: {}", plan().string(), error.message()));
    const PictureRanges there = *begun();
    differing = differing_in(there, mine);
    const std::string origin = plan().string();
    const Json json = parse_json(read_text(plan()), origin);
    const Where where(origin);
    std::uint64_t planned_nodes = 0;
    decode(member(json, where, "nodes"), Where(where, "nodes"), planned_nodes);
    chunks_ =
        chunks_of(there.part_count, there.params.size.pixels(), std::max<std::uint64_t>(planned_nodes, 1));
    return there;
}

std::optional<PartRange> PictureFolder::claim(const std::string& node) {
    for (; next_ < chunks_.size(); ++next_) {
        const std::error_code error = make_new_file(chunk(next_), node + "\n");
        if (!error) return chunks_[next_++];
        if (error != std::errc::file_exists)
            throw std::runtime_error(
                fmt::format("cannot write {}: {}", chunk(next_).string(), error.message()));
    }
    return std::nullopt;
}

void PictureFolder::give_up_claims(const std::string& node) const {
    std::vector<PartRange> kept;
    for (const DeviceParts& each : made_by(node))
        kept.insert(kept.end(), each.parts.begin(), each.parts.end());
    kept = joined(std::move(kept));
    for (std::size_t i = 0; i < chunks_.size(); ++i) {
        const auto holds = [&](const PartRange& range) {
            return range.first <= chunks_[i].first && chunks_[i].end <= range.end;
        };
        std::error_code ignored;
        if (!fs::exists(chunk(i), ignored) || read_text(chunk(i)) != node + "\n") continue;
        if (std::none_of(kept.begin(), kept.end(), holds)) fs::remove(chunk(i));
    }
}

/// The ranges last: a film without them is of nobody's claims.
void PictureFolder::leave(const std::string& node, const FilmSums& sums,
                          const std::vector<DeviceParts>& by) const {
    std::vector<DeviceParts> all = made_by(node);
    FilmSums whole = sums;
    if (!all.empty()) add_sums(whole, read_film(film(node)));
    for (DeviceParts parts : by) {
        parts.device = node + "/" + parts.device;
        all.push_back(parts);
    }
    write_film(film(node), whole);
    write_file(ranges(node), dump_json(parts_json(all)) + "\n");
}

std::vector<std::string> PictureFolder::nodes() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(path_ / "films"))
        if (entry.path().extension() == ".json" && !entry.path().filename().string().starts_with('.'))
            names.push_back(entry.path().stem().string());
    std::sort(names.begin(), names.end());
    return names;
}

std::vector<DeviceParts> PictureFolder::made_by(const std::string& node) const {
    std::error_code ignored;
    if (!fs::exists(ranges(node), ignored)) return {};
    return parse_parts(read_text(ranges(node)), ranges(node).string());
}

std::vector<DeviceParts> PictureFolder::made() const {
    std::vector<DeviceParts> all;
    for (const std::string& node : nodes())
        for (const DeviceParts& each : made_by(node)) all.push_back(each);
    return all;
}

FilmSums PictureFolder::merged() const {
    std::optional<FilmSums> sums;
    for (const std::string& node : nodes()) {
        FilmSums read = read_film(film(node));
        if (sums)
            add_sums(*sums, read);
        else
            sums = std::move(read);
    }
    return std::move(sums).value();
}

}  // namespace ptb
