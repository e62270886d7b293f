#include "bench/cli/outputs.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <iterator>
#include <tuple>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "bench/compare/row.h"
#include "bench/plan/tuned.h"
#include "bench/report/ladder.h"

namespace ptb {
namespace {

namespace fs = std::filesystem;

constexpr auto journal_name = "journal.jsonl", result_name = "result.json";

/// "2016-05-17T09:30:00Z" -> "2016-05-17T09-30-00Z-quick"; numbered when that is there already.
fs::path default_folder(const std::string& config, const std::string& started_at) {
    const fs::path base = fs::path("ptbench-results") / file_safe(started_at + "-" + config);
    fs::path folder = base;
    std::error_code ignored;
    for (int n = 2; fs::exists(folder, ignored); ++n) folder = fmt::format("{}-{}", base.string(), n);
    return folder;
}

bool create_folder(const fs::path& folder) {
    std::error_code error;
    const bool created = fs::create_directories(folder, error);
    if (error) throw UsageError(fmt::format("--out: cannot create {}: {}", folder.string(), error.message()));
    return created;
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

/// A case, and the name of the picture that it writes unless a later one of a list does.
using Pictured = std::pair<Case, std::string>;

std::vector<Pictured> pictures_of_devices(std::vector<Case> cases) {
    std::stable_sort(cases.begin(), cases.end(),
                     [](const Case& a, const Case& b) { return rank(a) < rank(b); });
    std::vector<Pictured> pictures;
    for (const Case& c : cases) pictures.emplace_back(c, file_safe(c.device) + ".png");
    return pictures;
}

/// Which of them are at equal time, their times will tell.
std::vector<Pictured> pictures_of_cases(const std::vector<Case>& cases) {
    std::vector<Pictured> pictures;
    for (const Case& c : cases)
        if (as_asked(c).work_group.implicit())
            pictures.emplace_back(c, file_safe(c.device + " " + case_text(c)) + ".png");
    return pictures;
}

std::vector<Pictured> pictures_of(Pictures kind, const std::vector<Case>& cases) {
    return kind == Pictures::best ? pictures_of_devices(cases) : pictures_of_cases(cases);
}

std::vector<Case> cases_at_equal_time(const std::vector<Record>& records) {
    std::vector<Case> cases;
    for (const Ladder& ladder : ladders(records))
        for (const std::size_t i : ladder.cases) cases.push_back(records[i].params);
    return cases;
}

/// A timed image is written even where it is then found to be wrong.
bool left_a_picture(const Record& record) { return record.work && record.work->segments > 0; }

std::set<Case> pictured(const std::vector<Record>& records) {
    std::set<Case> cases;
    for (const Record& record : records)
        if (left_a_picture(record)) cases.insert(record.params);
    return cases;
}

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
    asked_ = asked_for({{"json", flags.json},
                        {"csv", flags.csv},
                        {"csv-samples", flags.csv_samples},
                        {"md", flags.md},
                        {"html", flags.html}});
    refuse_shared_files(files());
    created_ = create_folder(folder_);
    if (!lock_.take_folder(folder_))
        throw UsageError(
            fmt::format("--out: {} is in use by another run; name another folder", folder_.string()));
    check_asked(asked_);
    check_writable("--out", folder_ / result_name);
}

Outputs::~Outputs() {
    std::error_code ignored;
    if (!created_ || !fs::is_empty(folder_, ignored)) return;
    fs::remove(folder_, ignored);
    if (folder_.parent_path() == "ptbench-results") fs::remove(folder_.parent_path(), ignored);  // when empty
}

std::map<Case, ImageFile> Outputs::pictures(Pictures kind, const std::vector<Case>& cases,
                                            const std::vector<Record>& done) {
    kind_ = kind;
    std::map<Case, ImageFile> files;
    const std::set<Case> there = pictured(done);
    std::set<std::string> kept;
    std::size_t rank = 0;
    for (const auto& [c, name] : pictures_of(kind, cases)) {
        const std::string file = (folder_ / name).string();
        pictures_.insert(file);
        if (there.contains(c)) {
            kept.insert(file);
            std::erase_if(files, [&](const auto& lesser) { return lesser.second.path == file; });
        } else {
            files[c] = {file, rank++};
        }
    }
    remove_pictures_but(kept);  // an older run's is none of this one's
    return files;
}

void Outputs::remove_pictures_but(const std::set<std::string>& kept) const {
    std::error_code ignored;
    for (const auto& file : pictures_)
        if (!kept.contains(file)) fs::remove(file, ignored);
}

std::vector<Picture> Outputs::made(const std::vector<Record>& records) const {
    std::map<Case, const Record*> record_of;
    std::vector<Case> cases;
    for (const Record& record : records) {
        record_of[record.params] = &record;
        cases.push_back(record.params);
    }
    if (kind_ == Pictures::equal_time) cases = cases_at_equal_time(records);
    std::map<std::string, Case> maker;
    for (const auto& [c, name] : pictures_of(kind_, cases))
        if (left_a_picture(*record_of.at(c))) maker[name] = c;
    std::vector<Picture> pictures;
    std::error_code ignored;
    for (const auto& [file, c] : maker)
        if (fs::exists(folder_ / file, ignored)) pictures.push_back({c, file});
    return pictures;
}

void Outputs::keep(const std::vector<Picture>& pictures) const {
    std::set<std::string> kept;
    for (const Picture& picture : pictures) kept.insert((folder_ / picture.file).string());
    if (kind_ == Pictures::equal_time) remove_pictures_but(kept);
}

bool Outputs::stdout_is_taken() const { return takes_stdout(asked_); }

fs::path Outputs::journal() const { return folder_ / journal_name; }

void Outputs::write(const ResultFile& result, const PublishedTable& published) {
    try {
        write_all(result, published);
    } catch (const std::exception& error) {
        std::error_code ignored;
        throw std::runtime_error(fmt::format("{}; the run's data is in {}", error.what(),
                                             fs::absolute(journal(), ignored).string()));
    }
}

Destinations Outputs::files() const {
    Destinations files{{"json", (folder_ / result_name).string()},
                       {"csv", (folder_ / "result.csv").string()},
                       {"md", (folder_ / "table.md").string()}};
    files.insert(files.end(), asked_.begin(), asked_.end());
    return files;
}

void Outputs::write_all(const ResultFile& result, const PublishedTable& published) {
    for (const auto& [format, destination] : files()) {
        write_to(destination, text_in(format, {{result, folder_}}, published));
        if (destination != to_stdout) written_.push_back(destination);
    }
}

std::vector<std::string> Outputs::written() const {
    std::vector<std::string> files = written_;
    std::copy_if(pictures_.begin(), pictures_.end(), std::back_inserter(files), [](const std::string& file) {
        std::error_code ignored;
        return fs::exists(file, ignored);
    });
    return files;
}

}  // namespace ptb
