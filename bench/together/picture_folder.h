#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "bench/together/picture_ranges.h"
#include "core/render/film_sums.h"

namespace ptb {

/// A picture that several nodes make, in a folder that they share. Nobody waits for anybody: nodes claim
/// chunks of parts, each by a file that only one can make, and leave the film of what they made. Methods
/// throw std::runtime_error with the file and the reason.
class PictureFolder {
  public:
    /// Makes the folder where there is none.
    explicit PictureFolder(std::filesystem::path path);

    /// Whoever comes first says what is made, and for how many nodes. Returns what is there, and adds what
    /// differs from `mine` in it.
    PictureRanges join(const PictureRanges& mine, std::size_t nodes, std::vector<std::string>& differing);
    /// What was begun there, or nothing.
    std::optional<PictureRanges> begun() const;

    // Once it is joined:

    /// What this node claimed and left no film of, or of a part, is open again. For a process that is alone
    /// on its node.
    void give_up_claims(const std::string& node) const;
    std::filesystem::path lock(const std::string& node) const { return path_ / "films" / (node + ".lock"); }
    /// What is missing of the next chunk that nobody claimed, range by range, or nothing.
    std::optional<PartRange> claim(const std::string& node);

    /// Adds to the film that this node left.
    void leave(const std::string& node, const FilmSums& sums, const std::vector<DeviceParts>& by) const;
    /// Who made what so far, devices named NODE/DEVICE.
    std::vector<DeviceParts> made() const;
    /// Nodes that claimed parts of which they left no film.
    std::set<std::string> owing() const;
    /// All films added. There is at least one.
    FilmSums merged() const;

  private:
    std::filesystem::path plan() const { return path_ / "picture.json"; }
    std::filesystem::path chunk(std::size_t number) const;
    std::filesystem::path ranges(const std::string& node) const { return path_ / "films" / (node + ".json"); }
    std::filesystem::path film(const std::string& node, const std::vector<DeviceParts>& by) const;
    void claim_chunk(const std::string& node);
    std::vector<DeviceParts> made_by(const std::string& node) const;
    std::vector<DeviceParts> made_by_now(const std::string& node) const;
    std::vector<std::string> nodes() const;

    std::filesystem::path path_;
    PictureRanges picture_;
    std::vector<PartRange> chunks_;
    std::size_t next_ = 0;            ///< of them, to be tried
    std::vector<PartRange> claimed_;  ///< of one, and not handed out yet
};

/// A picture cut into chunks: ever smaller ones, so that nodes end together however fast they are, each of
/// whole rounds where it is longer than one.
std::vector<PartRange> chunks_of(std::uint64_t parts, std::uint64_t round_parts, std::size_t nodes);

}  // namespace ptb
