#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/file/path_lock.h"

namespace ptb {

/// An installed OpenCL driver: the .icd file that names it, or the library itself (OCL_ICD_FILENAMES).
struct Icd {
    std::string file;     ///< path of the .icd file or of the library
    std::string library;  ///< the .icd file's text
    bool operator==(const Icd&) const = default;
};

/// Whatever the loader finds by itself.
inline const Icd any_icd{};

/// The environment's say in which drivers a loader sees.
struct IcdEnvironment {
    std::string vendors;    ///< OCL_ICD_VENDORS: a folder or one .icd file; empty means /etc/OpenCL/vendors
    std::string filenames;  ///< OCL_ICD_FILENAMES: libraries, separated by colons
};

IcdEnvironment icd_environment();

/// The drivers a loader would find, sorted by file name, the extra libraries last.
std::vector<Icd> find_icds(const IcdEnvironment& environment = icd_environment());

/// The driver that `DeviceInfo::icd` names.
Icd icd_from_file(const std::string& file);

/// A private folder with one .icd file: with OCL_ICD_VENDORS pointing to it, a loader sees only that driver.
/// None for `any_icd`. Removed on destruction; where the process was killed, by a later one that makes
/// another.
class IcdFolder {
  public:
    explicit IcdFolder(const Icd& icd);
    ~IcdFolder();
    IcdFolder(const IcdFolder&) = delete;
    IcdFolder& operator=(const IcdFolder&) = delete;
    const std::filesystem::path& path() const { return path_; }

    /// What to set (or, when empty, unset) for a process that shall see only this driver.
    std::map<std::string, std::string> environment() const;

  private:
    std::filesystem::path path_;
    PathLock held_;
};

/// Lets this process see only that driver; to be called before OpenCL is.
void see_only(const IcdFolder& folder);

}  // namespace ptb
