#include "bench/cli/formats.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <iterator>
#include <map>

#include <fmt/format.h>

#include "bench/cli/outputs.h"
#include "bench/plan/data_dir.h"
#include "bench/record/file.h"
#include "bench/record/result_file.h"
#include "bench/report/csv.h"
#include "bench/report/formats/formats.h"
#include "bench/report/html/page.h"
#include "bench/report/markdown.h"

namespace ptb {
namespace {

namespace fs = std::filesystem;

std::string page_of(const std::vector<StoredRun>& runs, const PublishedTable& published) {
    std::vector<PageRun> shown;
    for (const StoredRun& run : runs)
        shown.push_back(
            {run.result, figures(run.result, run.folder, data_dir() / "results" / "references"), run.name});
    return page(shown, published);
}

using Parts = std::vector<fs::path>;

/// How many parts all have in common, counted as `part` counts.
template <class Part>
std::size_t common(const std::vector<Parts>& all, std::size_t most, Part part) {
    std::size_t n = 0;
    const auto same = [&](const Parts& parts) { return part(parts, n) == part(all.front(), n); };
    while (n < most && std::all_of(all.begin(), all.end(), same)) ++n;
    return n;
}

void print_to_stdout(const std::string& text) {
    const bool whole = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
    if (!whole || std::fflush(stdout) != 0) {
        throw std::runtime_error(fmt::format("cannot write to stdout: {}", std::strerror(errno)));
    }
}

}  // namespace

std::vector<std::string> names_of(const std::vector<fs::path>& files) {
    std::vector<Parts> all;
    std::size_t fewest = static_cast<std::size_t>(-1);
    for (const fs::path& file : files) {
        const fs::path plain = file.lexically_normal();
        all.emplace_back(plain.begin(), plain.end());
        fewest = std::min(fewest, all.back().size());
    }
    std::vector<std::string> names(files.size());
    if (files.size() < 2) return names;
    const auto from_front = [](const Parts& parts, std::size_t n) { return parts[n]; };
    const auto from_back = [](const Parts& parts, std::size_t n) { return parts[parts.size() - 1 - n]; };
    const auto front = common(all, fewest, from_front);
    const auto back = common(all, fewest - front, from_back);
    for (std::size_t i = 0; i < files.size(); ++i) {
        fs::path kept;
        for (std::size_t j = front; j + back < all[i].size(); ++j) kept /= all[i][j];
        names[i] = kept.string();
    }
    return names;
}

Destinations asked_for(const Destinations& all) {
    Destinations asked;
    std::copy_if(all.begin(), all.end(), std::back_inserter(asked),
                 [](const auto& each) { return !each.second.empty(); });
    return asked;
}

void check_asked(const Destinations& asked) {
    int taking_stdout = 0;
    for (const auto& [format, destination] : asked) {
        if (destination != to_stdout) check_writable("--" + format, destination);
        taking_stdout += destination == to_stdout ? 1 : 0;
    }
    if (taking_stdout > 1)
        throw UsageError(
            "only one of --json, --csv, --csv-samples, --md, --html and --format can write to stdout (-)");
}

/// Devices like /dev/null take both.
void refuse_shared_files(const Destinations& files) {
    std::map<fs::path, std::string> format_of;
    for (const auto& [format, file] : files) {
        std::error_code ignored;
        if (file == to_stdout || (fs::exists(file, ignored) && !fs::is_regular_file(file, ignored))) continue;
        const fs::path real = fs::weakly_canonical(fs::absolute(file, ignored), ignored);
        const auto [entry, is_new] = format_of.try_emplace(real.empty() ? fs::path(file) : real, format);
        if (entry->second != format)
            throw UsageError(
                fmt::format("{} is to hold both {} and {}; name two files", file, entry->second, format));
    }
}

bool takes_stdout(const Destinations& asked) {
    return std::any_of(asked.begin(), asked.end(), [](const auto& each) { return each.second == to_stdout; });
}

std::string text_in(const std::string& format, const std::vector<StoredRun>& runs,
                    const PublishedTable& published) {
    if (format == "html") return page_of(runs, published);
    if (runs.size() != 1)
        throw UsageError(fmt::format("{}: found {} runs; allowed: one, or --html", format, runs.size()));
    const ResultFile& result = runs.front().result;
    if (format == "json") return result_text(result);
    if (format == "csv-samples") return csv_samples(result);
    if (format == "csv") return csv(result);
    return format == "md" ? markdown(result, published) : format_named(format).write(result);
}

void write_to(const std::string& destination, const std::string& text) {
    if (destination == to_stdout) return print_to_stdout(text);
    write_file(destination, text);
}

}  // namespace ptb
