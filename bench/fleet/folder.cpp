#include "bench/fleet/folder.h"

#include <algorithm>

#include "bench/record/file.h"
#include "core/input/json.h"

namespace ptb {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> names_in(const fs::path& folder, const std::string& extension) {
    std::vector<std::string> names;
    std::error_code missing;
    for (const auto& entry : fs::directory_iterator(folder, missing))
        if (entry.path().extension() == extension && !entry.path().filename().string().starts_with('.'))
            names.push_back(entry.path().stem().string());
    std::sort(names.begin(), names.end());
    return names;
}

}  // namespace

std::vector<std::string> FleetFolder::with_journal() const { return names_in(nodes(), ".jsonl"); }
std::vector<std::string> FleetFolder::refused() const { return names_in(nodes(), ".refused"); }

void FleetFolder::refuse(const std::string& node, const std::string& reason) const {
    std::error_code ignored;
    if (reason.empty())
        fs::remove(refusal(node), ignored);
    else
        write_file(refusal(node), reason + "\n");
}

std::string FleetFolder::reason_of_refusal(const std::string& node) const {
    const std::string text = read_text(refusal(node));
    return text.substr(0, text.find('\n'));
}

bool is_fleet(const fs::path& folder) {
    std::error_code ignored;
    return fs::is_regular_file(FleetFolder{folder}.plan(), ignored);
}

}  // namespace ptb
