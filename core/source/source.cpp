#include "core/source/source.h"

#include <fstream>
#include <set>
#include <sstream>

#include <fmt/format.h>

#include "core/source/embedded.h"
#include "core/source/text_hash.h"

namespace ptb {

namespace {

/// The quoted name of an include line, or nothing.
std::string included(const std::string& line) {
    const std::string directive = "#include \"";
    if (line.rfind(directive, 0) != 0) return "";
    const auto end = line.find('"', directive.size());
    return end == std::string::npos ? "" : line.substr(directive.size(), end - directive.size());
}

bool starts_with(const std::string& line, const char* word) { return line.rfind(word, 0) == 0; }

/// How deep in conditions a file's lines are; what a header has around all of it to be there once is none.
class Conditions {
  public:
    explicit Conditions(const std::string& file) : depth_(file.ends_with(".h") ? -1 : 0) {}
    void read(const std::string& line) {
        if (starts_with(line, "#if")) ++depth_;
        if (starts_with(line, "#endif")) --depth_;
    }
    bool any() const { return depth_ > 0; }

  private:
    int depth_;
};

class Flattener {
  public:
    explicit Flattener(const std::filesystem::path& folder) : folder_(folder) {}

    /// A file that may be left out by a condition is there again for the next one that asks for it.
    void add(const std::string& file, const std::string& from, bool conditional = false) {
        if (seen_.contains(file) || !open_.insert(file).second) return;  // once is enough
        if (!conditional) seen_.insert(file);
        std::istringstream lines(read(file, from));
        source_.text += fmt::format("#line 1 \"{}\"\n", file);
        Conditions conditions(file);
        std::string line;
        for (int number = 1; std::getline(lines, line); ++number) {
            conditions.read(line);
            const std::string name = included(line);
            if (name.empty()) {
                source_.text += line + '\n';
                continue;
            }
            add(name, fmt::format("{}:{}", file, number), conditional || conditions.any());
            source_.text += fmt::format("#line {} \"{}\"\n", number + 1, file);
        }
        open_.erase(file);
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
    std::set<std::string> seen_, open_;
    KernelSource source_;
};

}  // namespace

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
