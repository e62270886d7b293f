#include "bench/together/picture_folder.h"

#include <algorithm>
#include <fstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bench/record/file.h"
#include "bench/record/json.h"
#include "bench/together/hand_out.h"
#include "bench/worker/device_worker.h"
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

/// Words of what two pictures differ in, but for how they are cut.
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

/// Parts that are in films, in order.
std::vector<PartRange> ranges_of(const std::vector<DeviceParts>& by) {
    std::vector<PartRange> all;
    for (const DeviceParts& each : by) all.insert(all.end(), each.parts.begin(), each.parts.end());
    return joined(std::move(all));
}

/// What of a chunk is in none of the ranges, which are in order.
std::vector<PartRange> missing_in(const std::vector<PartRange>& ranges, const PartRange& chunk) {
    std::vector<PartRange> missing;
    std::uint64_t next = chunk.first;
    for (const PartRange& range : ranges) {
        const std::uint64_t until = std::min(range.first, chunk.end);
        if (until > next) missing.push_back({next, until});
        next = std::max(next, range.end);
    }
    if (next < chunk.end) missing.push_back({next, chunk.end});
    return missing;
}

/// "n1\n" of a claim's file, or nothing.
std::string node_in(const fs::path& claim) {
    std::error_code ignored;
    const std::string text = fs::exists(claim, ignored) ? read_text(claim) : "";
    return text.substr(0, text.find('\n'));
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
    picture_ = *begun();
    differing = differing_in(picture_, mine);
    const std::string origin = plan().string();
    const Json json = parse_json(read_text(plan()), origin);
    const Where where(origin);
    std::uint64_t planned_nodes = 0;
    decode(member(json, where, "nodes"), Where(where, "nodes"), planned_nodes);
    chunks_ = chunks_of(picture_.part_count, picture_.params.size.pixels(),
                        std::max<std::uint64_t>(planned_nodes, 1));
    return picture_;
}

/// Network file systems show a folder as it was a while ago, until one changes it oneself.
std::vector<DeviceParts> PictureFolder::made_by_now(const std::string& node) const {
    const FileBeside change(ranges(node));
    std::ofstream(change.path());
    return made();
}

std::optional<PartRange> PictureFolder::claim(const std::string& node) {
    if (claimed_.empty()) claim_chunk(node);
    if (claimed_.empty()) return std::nullopt;
    const PartRange next = claimed_.back();
    claimed_.pop_back();
    return next;
}

/// From the last one on, and once around: others may have given up what they claimed, with some of it made.
void PictureFolder::claim_chunk(const std::string& node) {
    for (std::size_t tried = 0; tried < chunks_.size() && claimed_.empty(); ++tried) {
        const std::size_t number = next_++ % chunks_.size();
        std::error_code ignored;
        if (fs::exists(chunk(number), ignored)) continue;
        const std::error_code error = make_new_file(chunk(number), node + "\n");
        if (!error)
            claimed_ = missing_in(ranges_of(made_by_now(node)), chunks_[number]);
        else if (error != std::errc::file_exists)
            throw std::runtime_error(
                fmt::format("cannot write {}: {}", chunk(number).string(), error.message()));
    }
}

void PictureFolder::give_up_claims(const std::string& node) const {
    const std::vector<PartRange> kept = ranges_of(made());
    for (std::size_t i = 0; i < chunks_.size(); ++i)
        if (node_in(chunk(i)) == node && !missing_in(kept, chunks_[i]).empty()) fs::remove(chunk(i));
}

std::set<std::string> PictureFolder::owing() const {
    const std::vector<PartRange> kept = ranges_of(made());
    std::set<std::string> nodes;
    for (std::size_t i = 0; i < chunks_.size(); ++i)
        if (!missing_in(kept, chunks_[i]).empty()) nodes.insert(node_in(chunk(i)));
    nodes.erase("");
    return nodes;
}

/// Another one whenever a node has made more, so that its ranges are always of a whole film.
fs::path PictureFolder::film(const std::string& node, const std::vector<DeviceParts>& by) const {
    return path_ / "films" / fmt::format("{}.{}.film", node, parts_made(by));
}

void PictureFolder::leave(const std::string& node, const FilmSums& sums,
                          const std::vector<DeviceParts>& by) const {
    const std::vector<DeviceParts> before = made_by(node);
    PictureRanges left = picture_;
    left.devices = before;
    for (DeviceParts parts : by) {
        parts.device = node + "/" + parts.device;
        left.devices.push_back(parts);
    }
    FilmSums whole = sums;
    if (!before.empty()) add_sums(whole, read_film(film(node, before)));
    const fs::path file = film(node, left.devices);
    const FileBeside beside(file);
    write_film(beside.path(), whole);
    if (const std::error_code error = beside.put_in_place())
        throw std::runtime_error(fmt::format("cannot write {}: {}", file.string(), error.message()));
    write_file(ranges(node), to_text(left) + "\n");
    if (!before.empty()) fs::remove(film(node, before));
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
    const std::string origin = ranges(node).string();
    const PictureRanges there = parse_picture_plan(read_text(ranges(node)), origin);
    std::vector<std::string> differing = differing_in(there, picture_);
    if (there.cut != picture_.cut || there.part_count != picture_.part_count)
        differing.emplace_back("how it is cut into parts");
    if (!differing.empty())
        throw VersionMismatch(
            fmt::format("--fleet: {} is of another picture: {}", origin, fmt::join(differing, "; ")));
    return there.devices;
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
        FilmSums read = read_film(film(node, made_by(node)));
        if (sums)
            add_sums(*sums, read);
        else
            sums = std::move(read);
    }
    return std::move(sums).value();
}

}  // namespace ptb
