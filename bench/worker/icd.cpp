#include "bench/worker/icd.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>
#include <stdlib.h>

#include "core/input/usage_error.h"

namespace ptb {
namespace {

namespace fs = std::filesystem;

std::string variable(const char* name) {
    const char* const value = std::getenv(name);
    return value == nullptr ? std::string() : std::string(value);
}

std::string text_of(const fs::path& file) {
    std::ifstream in(file);
    return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<Icd> icds_of_folder(const fs::path& folder) {
    std::vector<Icd> icds;
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(folder, ignored)) {
        if (entry.path().extension() == ".icd") icds.push_back(icd_from_file(entry.path().string()));
    }
    std::sort(icds.begin(), icds.end(), [](const Icd& a, const Icd& b) { return a.file < b.file; });
    return icds;
}

constexpr const char* prefix = "ptbench-icd-";
constexpr const char* lock_name = "lock";  ///< held by the folder's process

/// Folders whose process is no more. Not before a day has passed: some file systems know no locks.
void remove_abandoned(const fs::path& temporary) {
    std::error_code error;
    const auto now = fs::file_time_type::clock::now();
    for (fs::directory_iterator at(temporary, error), end; !error && at != end; at.increment(error)) {
        if (!at->path().filename().string().starts_with(prefix)) continue;
        std::error_code gone;
        const auto written = at->last_write_time(gone);
        if (gone || now - written < std::chrono::hours(24)) continue;
        PathLock lock;
        if (lock.take_file(at->path() / lock_name)) fs::remove_all(at->path(), gone);
    }
}

}  // namespace

IcdEnvironment icd_environment() { return {variable("OCL_ICD_VENDORS"), variable("OCL_ICD_FILENAMES")}; }

Icd icd_from_file(const std::string& file) {
    if (file.empty()) return any_icd;
    if (fs::path(file).extension() == ".icd") return {file, text_of(file)};
    return {file, file};
}

std::vector<Icd> find_icds(const IcdEnvironment& environment) {
    const fs::path vendors = environment.vendors.empty() ? "/etc/OpenCL/vendors" : environment.vendors;
    std::error_code ignored;
    const bool folder = fs::is_directory(vendors, ignored);
    std::vector<Icd> icds = folder ? icds_of_folder(vendors) : std::vector<Icd>();
    if (!folder && fs::exists(vendors, ignored)) icds.push_back(icd_from_file(vendors.string()));
    std::istringstream libraries(environment.filenames);
    for (std::string library; std::getline(libraries, library, ':');) {
        if (!library.empty()) icds.push_back(icd_from_file(library));
    }
    return icds;
}

IcdFolder::IcdFolder(const Icd& icd) {
    if (icd == any_icd) return;
    std::error_code error;
    const fs::path temporary = fs::temp_directory_path(error);
    if (error) throw UsageError(fmt::format("TMPDIR: found {}, which is no folder", variable("TMPDIR")));
    remove_abandoned(temporary);
    std::string pattern = (temporary / fmt::format("{}XXXXXX", prefix)).string();
    if (::mkdtemp(pattern.data()) == nullptr) {
        throw std::runtime_error(fmt::format("cannot create a folder like {}", pattern));
    }
    path_ = pattern;
    (void)held_.take_file(path_ / lock_name);  // a new folder is nobody else's
    std::ofstream out(path_ / fs::path(icd.file).filename().replace_extension(".icd"));
    if (!(out << icd.library << std::flush)) {
        throw std::runtime_error(fmt::format("cannot write into {}", pattern));
    }
}

IcdFolder::~IcdFolder() {
    std::error_code ignored;
    if (!path_.empty()) fs::remove_all(path_, ignored);
}

std::map<std::string, std::string> IcdFolder::environment() const {
    if (path_.empty()) return {};
    // CUDA's loader appends file names to the folder as it stands: without the slash it finds nothing.
    return {{"OCL_ICD_VENDORS", path_.string() + "/"}, {"OCL_ICD_FILENAMES", ""}};
}

void see_only(const IcdFolder& folder) {
    for (const auto& [name, value] : folder.environment()) {
        if (value.empty()) {
            ::unsetenv(name.c_str());
        } else {
            ::setenv(name.c_str(), value.c_str(), 1);
        }
    }
}

}  // namespace ptb
