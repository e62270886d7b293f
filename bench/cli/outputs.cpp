#include "bench/cli/outputs.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <iterator>
#include <tuple>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "bench/record/file.h"
#include "bench/record/result_file.h"
#include "bench/report/csv.h"
#include "bench/report/markdown.h"

namespace ptb {
namespace {

namespace fs = std::filesystem;

constexpr auto to_stdout = "-";
constexpr auto journal_name = "journal.jsonl", result_name = "result.json";

using Files = std::vector<std::pair<std::string, fs::path>>;  ///< format and file

/// Two formats in one file: the second would overwrite the first. Devices like /dev/null take both.
void refuse_shared_files(const Files& files) {
    std::map<fs::path, std::string> format_of;
    for (const auto& [format, file] : files) {
        std::error_code ignored;
        if (fs::exists(file, ignored) && !fs::is_regular_file(file, ignored)) continue;
        const auto [entry, is_new] =
            format_of.try_emplace(fs::weakly_canonical(fs::absolute(file), ignored), format);
        if (entry->second != format)
            throw UsageError(fmt::format("{} is to hold both {} and {}; name two files", file.string(),
                                         entry->second, format));
    }
}

void check_asked(const std::vector<std::pair<std::string, std::string>>& asked) {
    int taking_stdout = 0;
    for (const auto& [format, destination] : asked) {
        if (destination != to_stdout) check_writable("--" + format, destination);
        taking_stdout += destination == to_stdout ? 1 : 0;
    }
    if (taking_stdout > 1)
        throw UsageError("only one of --json, --csv, --csv-samples and --md can write to stdout (-)");
}

/// "2016-05-17T09:30:00Z" -> "2016-05-17T09-30-00Z-quick"; numbered when that is there already.
fs::path default_folder(const std::string& config, const std::string& started_at) {
    const fs::path base = fs::path("ptbench-results") / file_safe(started_at + "-" + config);
    fs::path folder = base;
    for (int n = 2; fs::exists(folder); ++n) folder = fmt::format("{}-{}", base.string(), n);
    return folder;
}

bool create_folder(const fs::path& folder) {
    std::error_code error;
    const bool created = fs::create_directories(folder, error);
    if (error) throw UsageError(fmt::format("--out: cannot create {}: {}", folder.string(), error.message()));
    return created;
}

std::string text_in(const std::string& format, const ResultFile& result, const PublishedTable& published) {
    if (format == "json") return result_text(result);
    if (format == "csv-samples") return csv_samples(result);
    return format == "csv" ? csv(result) : markdown(result, published);
}

void print_to_stdout(const std::string& text) {
    const bool whole = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
    if (!whole || std::fflush(stdout) != 0) {
        throw std::runtime_error(fmt::format("cannot write to stdout: {}", std::strerror(errno)));
    }
}

/// A resumed run goes on in the folder where it began, if that is where its file still is.
fs::path folder_of(const RunFlags& flags, const std::string& config, const std::string& started_at) {
    if (!flags.out.empty()) return flags.out;
    const fs::path resumed = flags.resume;
    const bool of_a_run = resumed.filename() == journal_name || resumed.filename() == result_name;
    if (!of_a_run) return default_folder(config, started_at);
    return resumed.has_parent_path() ? resumed.parent_path() : ".";
}

/// What makes a better picture: the pt kernel, an implicit work-group, more samples.
auto rank(const Case& c) { return std::tuple(c.kernel == "pt", c.work_group.implicit(), c.spp); }

}  // namespace

std::string file_safe(std::string text) {
    for (char& c : text) {
        const bool safe = std::isalnum(static_cast<unsigned char>(c)) || c == '.' || c == '_' || c == '-';
        if (!safe) c = '-';
    }
    if (text.starts_with('.')) text.front() = '-';
    return text;
}

void check_writable(const std::string& flag, const fs::path& file) {
    std::error_code ignored;
    const bool existed = fs::exists(file, ignored);
    const int fd = ::open(file.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | O_NONBLOCK, 0666);
    if (fd < 0) {
        throw UsageError(fmt::format("{}: cannot write {}: {}", flag, file.string(), std::strerror(errno)));
    }
    ::close(fd);
    if (!existed) fs::remove(file, ignored);
}

Outputs::Outputs(fs::path folder) : folder_(std::move(folder)) {}

// Once the delegated constructor is done, the destructor tidies up after one that throws.
Outputs::Outputs(const RunFlags& flags, const std::string& config, const std::string& started_at)
    : Outputs(folder_of(flags, config, started_at)) {
    for (const auto& [format, destination] :
         {std::pair("json", flags.json), std::pair("csv", flags.csv),
          std::pair("csv-samples", flags.csv_samples), std::pair("md", flags.md)}) {
        if (!destination.empty()) asked_.emplace_back(format, destination);
    }
    refuse_shared_files(files());
    created_ = create_folder(folder_);
    check_asked(asked_);
    check_writable("--out", folder_ / result_name);
}

Outputs::~Outputs() {
    std::error_code ignored;
    if (!created_ || !fs::is_empty(folder_, ignored)) return;
    fs::remove(folder_, ignored);
    if (folder_.parent_path() == "ptbench-results") fs::remove(folder_.parent_path(), ignored);  // when empty
}

std::map<Case, std::string> Outputs::pictures(const std::vector<Case>& cases, const std::set<Case>& done) {
    std::map<Case, std::string> files;
    std::set<std::string> kept;
    std::map<std::string, const Case*> best;
    for (const Case& c : cases) {
        const Case*& so_far = best[c.device];
        if (so_far != nullptr && rank(c) < rank(*so_far)) continue;
        so_far = &c;
        const std::string file = (folder_ / (file_safe(c.device) + ".png")).string();
        pictures_.insert(file);
        if (done.contains(c)) {
            kept.insert(file);
            std::erase_if(files, [&](const auto& lesser) { return lesser.second == file; });
        } else {
            files[c] = file;
        }
    }
    std::error_code ignored;
    for (const auto& file : pictures_)
        if (!kept.contains(file)) fs::remove(file, ignored);  // an older run's is none of this one's
    return files;
}

bool Outputs::stdout_is_taken() const {
    return std::any_of(asked_.begin(), asked_.end(),
                       [](const auto& each) { return each.second == to_stdout; });
}

fs::path Outputs::journal() const { return folder_ / journal_name; }

void Outputs::write(const ResultFile& result, const PublishedTable& published) {
    try {
        write_all(result, published);
    } catch (const std::exception& error) {
        throw std::runtime_error(
            fmt::format("{}; the run's data is in {}", error.what(), fs::absolute(journal()).string()));
    }
}

std::vector<std::pair<std::string, fs::path>> Outputs::files() const {
    Files files{
        {"json", folder_ / result_name}, {"csv", folder_ / "result.csv"}, {"md", folder_ / "table.md"}};
    for (const auto& [format, destination] : asked_) {
        if (destination != to_stdout) files.emplace_back(format, destination);
    }
    return files;
}

void Outputs::write_all(const ResultFile& result, const PublishedTable& published) {
    for (const auto& [format, file] : files()) {
        write_file(file, text_in(format, result, published));
        written_.push_back(file.string());
    }
    for (const auto& [format, destination] : asked_) {
        if (destination == to_stdout) print_to_stdout(text_in(format, result, published));
    }
}

std::vector<std::string> Outputs::written() const {
    std::vector<std::string> files = written_;
    std::copy_if(pictures_.begin(), pictures_.end(), std::back_inserter(files),
                 [](const std::string& file) { return fs::exists(file); });
    return files;
}

}  // namespace ptb
