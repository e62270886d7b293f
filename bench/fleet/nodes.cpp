#include "bench/fleet/nodes.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <optional>
#include <string_view>

#include <fmt/format.h>
#include <unistd.h>

#include "bench/record/host.h"
#include "core/input/printable.h"
#include "core/input/usage_error.h"

namespace ptb {
namespace {

constexpr std::size_t most_nodes = 100'000;

std::string in_environment(const char* name) {
    const char* const value = std::getenv(name);
    return value == nullptr ? "" : value;
}

/// A name becomes a file's.
bool is_name(std::string_view text) {
    const auto safe = [](unsigned char c) {
        return std::isalnum(c) != 0 || c == '-' || c == '_' || c == '.';
    };
    return !text.empty() && text.front() != '.' && text.front() != '-' &&
           std::all_of(text.begin(), text.end(), safe);
}

std::optional<int> number_in(std::string_view digits) {
    int number = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    const bool whole = error == std::errc() && end == digits.data() + digits.size();
    return whole && digits.front() != '-' ? std::optional(number) : std::nullopt;
}

/// Reads one list.
class NodeList {
  public:
    NodeList(const std::string& text, const std::string& origin)
        : text_(text), left_(text), origin_(origin) {}

    std::vector<std::string> nodes() {
        do {
            take_item({""});
        } while (take(','));
        if (!left_.empty()) fail();
        return nodes_;
    }

  private:
    bool take(char c) {
        if (left_.empty() || left_.front() != c) return false;
        left_.remove_prefix(1);
        return true;
    }

    std::string_view take_until(std::string_view ends) {
        const auto taken = left_.substr(0, left_.find_first_of(ends));
        left_.remove_prefix(taken.size());
        return taken;
    }

    /// What follows the beginnings: text, then numbers in brackets, and so on to the comma.
    void take_item(std::vector<std::string> beginnings) {
        while (!left_.empty() && left_.front() != ',') {
            const auto text = take_until("[,");
            for (std::string& beginning : beginnings) beginning += text;
            if (take('[')) beginnings = with_numbers(beginnings);
        }
        for (const std::string& name : beginnings)
            if (!is_name(name)) fail();
        nodes_.insert(nodes_.end(), beginnings.begin(), beginnings.end());
        if (nodes_.size() > most_nodes) fail();
    }

    std::vector<std::string> with_numbers(const std::vector<std::string>& beginnings) {
        std::vector<std::string> numbers, longer;
        do {
            add_range(take_until(",]"), numbers);
        } while (take(','));
        if (!take(']')) fail();
        for (const std::string& beginning : beginnings)
            for (const std::string& number : numbers) longer.push_back(beginning + number);
        if (longer.size() > most_nodes) fail();
        return longer;
    }

    /// "3-07": as many digits as the first one has.
    void add_range(std::string_view text, std::vector<std::string>& numbers) const {
        const auto dash = text.find('-');
        const std::string_view first = text.substr(0, dash);
        const auto begin = number_in(first);
        const auto end = dash == std::string_view::npos ? begin : number_in(text.substr(dash + 1));
        if (!begin || !end || *end < *begin || std::size_t(*end - *begin) > most_nodes) fail();
        for (std::int64_t number = *begin; number <= *end; ++number)
            numbers.push_back(fmt::format("{:0{}}", number, first.size()));
    }

    [[noreturn]] void fail() const {
        throw UsageError(fmt::format("{}: found \"{}\"; allowed: nodes as in n1,n[3-7],login", origin_,
                                     shortened(printable(text_), 60)));
    }

    const std::string& text_;
    std::string_view left_;
    const std::string& origin_;
    std::vector<std::string> nodes_;
};

/// A name that ends in a number, as that and what is before.
struct Numbered {
    std::string before;
    std::string digits;
};
Numbered numbered(const std::string& name) {
    const auto last = name.find_last_not_of("0123456789");
    const std::size_t begin = last == std::string::npos ? 0 : last + 1;
    return name.size() - begin > 9 ? Numbered{name, ""} : Numbered{name.substr(0, begin), name.substr(begin)};
}

/// Sorted numbers of one width: "1,3-5".
std::string ranges(const std::vector<int>& numbers, std::size_t width) {
    std::vector<std::string> texts;
    for (std::size_t i = 0; i < numbers.size();) {
        std::size_t j = i;
        while (j + 1 < numbers.size() && numbers[j + 1] == numbers[j] + 1) ++j;
        texts.push_back(j == i ? fmt::format("{:0{}}", numbers[i], width)
                               : fmt::format("{:0{}}-{:0{}}", numbers[i], width, numbers[j], width));
        i = j + 1;
    }
    return fmt::format("{}", fmt::join(texts, ","));
}

}  // namespace

std::string this_node() {
    const std::string by_slurm = in_environment("SLURMD_NODENAME");
    const std::string name = by_slurm.empty() ? host_name() : by_slurm;
    if (!is_name(name))
        throw UsageError(fmt::format(
            "--fleet: this node's name, \"{}\", cannot be a file's: set SLURMD_NODENAME", printable(name)));
    return name;
}

std::vector<std::string> nodes_in(const std::string& list, const std::string& origin) {
    return NodeList(list, origin).nodes();
}

std::string node_list(const std::vector<std::string>& nodes) {
    std::map<std::pair<std::string, std::size_t>, std::vector<int>> groups;
    for (const std::string& node : nodes) {
        const auto [before, digits] = numbered(node);
        auto& numbers = groups[{before, digits.size()}];
        if (!digits.empty()) numbers.push_back(*number_in(digits));
    }
    std::vector<std::string> texts;
    for (auto& [name, numbers] : groups) {
        std::sort(numbers.begin(), numbers.end());
        const std::string all = ranges(numbers, name.second);
        const bool single = all.find_first_of(",-") == std::string::npos;
        texts.push_back(single ? name.first + all : fmt::format("{}[{}]", name.first, all));
    }
    return fmt::format("{}", fmt::join(texts, ","));
}

std::vector<std::string> nodes_of_job() {
    const std::string list = in_environment("SLURM_JOB_NODELIST");
    return list.empty() ? std::vector<std::string>() : nodes_in(list, "SLURM_JOB_NODELIST");
}

}  // namespace ptb
