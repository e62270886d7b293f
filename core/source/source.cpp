#include "core/source/source.h"

#include <cstdint>
#include <fstream>
#include <set>
#include <sstream>

#include <fmt/format.h>

#include "core/source/embedded.h"

namespace ptb {

namespace {

/// The quoted name of an include line, or nothing.
std::string included(const std::string& line) {
    const std::string directive = "#include \"";
    if (line.rfind(directive, 0) != 0) return "";
    const auto end = line.find('"', directive.size());
    return end == std::string::npos ? "" : line.substr(directive.size(), end - directive.size());
}

class Flattener {
  public:
    explicit Flattener(const std::filesystem::path& folder) : folder_(folder) {}

    void add(const std::string& file, const std::string& from) {
        if (!seen_.insert(file).second) return;  // every file includes what it needs; once is enough
        std::istringstream lines(read(file, from));
        source_.text += fmt::format("#line 1 \"{}\"\n", file);
        std::string line;
        for (int number = 1; std::getline(lines, line); ++number) {
            const std::string name = included(line);
            if (name.empty()) {
                source_.text += line + '\n';
                continue;
            }
            add(name, fmt::format("{}:{}", file, number));
            source_.text += fmt::format("#line {} \"{}\"\n", number + 1, file);
        }
    }

    KernelSource finish() {
        source_.hash = text_hash(source_.text);
        return std::move(source_);
    }

  private:
    std::string read(const std::string& file, const std::string& from) {
        if (!folder_.empty()) {
            std::ifstream stream(folder_ / file, std::ios::binary);
            if (stream) {
                source_.overridden = true;
                return {std::istreambuf_iterator<char>(stream), {}};
            }
        }
        for (const EmbeddedFile& embedded : embedded_kernel_files())
            if (embedded.name == file) return std::string(embedded.text);
        throw SourceError(fmt::format("{}: kernel file \"{}\" is neither embedded{}", from, file,
                                      folder_.empty() ? "" : " nor in " + folder_.string()));
    }

    std::filesystem::path folder_;
    std::set<std::string> seen_;
    KernelSource source_;
};

}  // namespace

std::string text_hash(std::string_view text) {
    std::uint64_t hash = 0xcbf29ce484222325u;
    for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
    return fmt::format("{:016x}", hash);
}

std::vector<std::string> embedded_files() {
    std::vector<std::string> names;
    for (const EmbeddedFile& file : embedded_kernel_files()) names.emplace_back(file.name);
    return names;
}

KernelSource kernel_source(const std::string& file, const std::filesystem::path& override_folder) {
    Flattener flattener(override_folder);
    flattener.add(file, "kernel");
    return flattener.finish();
}

}  // namespace ptb
