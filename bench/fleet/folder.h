#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace ptb {

/// What is where in a fleet's folder, which all nodes share. Each of its files has one writer.
struct FleetFolder {
    std::filesystem::path path;

    std::filesystem::path plan() const { return path / "plan.json"; }
    std::filesystem::path result() const { return path / "result.json"; }
    std::filesystem::path journal(const std::string& node) const { return nodes() / (node + ".jsonl"); }
    std::filesystem::path refusal(const std::string& node) const { return nodes() / (node + ".refused"); }
    std::filesystem::path lock(const std::string& node) const { return nodes() / (node + ".lock"); }
    std::filesystem::path nodes() const { return path / "nodes"; }

    /// Sorted names of the nodes that have a journal, or were refused.
    std::vector<std::string> with_journal() const;
    std::vector<std::string> refused() const;

    /// Why this node took no part, for whoever reads the fleet; empty: it takes part.
    void refuse(const std::string& node, const std::string& reason) const;
    std::string reason_of_refusal(const std::string& node) const;
};

/// Whether a fleet was begun there.
bool is_fleet(const std::filesystem::path& folder);

}  // namespace ptb
