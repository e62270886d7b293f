#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <vector>

#include <fmt/format.h>

#include "core/input/printable.h"
#include "core/mesh/formats.h"

namespace ptb::mesh_formats {
namespace {

constexpr int longest_line = 1 << 16;

struct PlyProperty {
    int list_count_bytes = 0;  ///< 0: it is one value
    int value_bytes = 0;
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0;
    std::vector<PlyProperty> properties;
};

struct PlyHeader {
    std::string encoding;
    std::vector<PlyElement> elements;
    std::uintmax_t bytes = 0;
};

int bytes_of_type(const File& file, const std::string& type) {
    static const std::map<std::string, int> types = {
        {"char", 1},  {"uchar", 1},   {"int8", 1},   {"uint8", 1},  {"short", 2}, {"ushort", 2},
        {"int16", 2}, {"uint16", 2},  {"int", 4},    {"uint", 4},   {"int32", 4}, {"uint32", 4},
        {"float", 4}, {"float32", 4}, {"double", 8}, {"float64", 8}};
    const auto found = types.find(type);
    if (found == types.end())
        file.fail(fmt::format("\"{}\" is no type of PLY", shortened(printable(type), 40)));
    return found->second;
}

void read_property(const File& file, std::istringstream& words, PlyHeader& header) {
    if (header.elements.empty()) file.fail("a property comes before every element");
    std::string type;
    words >> type;
    PlyProperty property;
    if (type == "list") {
        words >> type;
        property.list_count_bytes = bytes_of_type(file, type);
        words >> type;
    }
    property.value_bytes = bytes_of_type(file, type);
    header.elements.back().properties.push_back(property);
}

void read_element(const File& file, std::istringstream& words, PlyHeader& header) {
    PlyElement element;
    if (!(words >> element.name >> element.count)) file.fail("an element has no name or no count");
    if (element.count > file.bytes)
        file.fail(fmt::format("it has {} bytes, and says that it has {} of \"{}\"", file.bytes, element.count,
                              shortened(printable(element.name), 40)));
    header.elements.push_back(element);
}

PlyHeader read_header(const File& file) {
    const std::string start = file.part(0, 1 << 16);
    std::istringstream lines(start);
    PlyHeader header;
    std::string line, word;
    if (!std::getline(lines, line) || !line.starts_with("ply")) file.fail("it does not begin with \"ply\"");
    while (std::getline(lines, line)) {
        if (!line.empty() && line.back() == '\r') line.pop_back();
        std::istringstream words(line);
        word.clear();
        words >> word;
        if (word == "format") words >> header.encoding;
        if (word == "element") read_element(file, words, header);
        if (word == "property") read_property(file, words, header);
        if (line != "end_header") continue;
        header.bytes = lines.eof() ? start.size() : static_cast<std::uintmax_t>(lines.tellg());
        return header;
    }
    file.fail("it has no \"end_header\" in its first 64 KiB");
}

[[noreturn]] void fail_short(const File& file, const PlyElement& element) {
    file.fail(fmt::format("it ends before the last of {} of \"{}\"", element.count,
                          shortened(printable(element.name), 40)));
}

/// The body of a binary file, walked through by what it says of itself.
class PlyWalk {
  public:
    PlyWalk(const File& file, const PlyHeader& header)
        : file_(file),
          stream_(file.path, std::ios::binary),
          left_(file.bytes - header.bytes),
          big_endian_(header.encoding == "binary_big_endian") {
        stream_.seekg(static_cast<std::streamoff>(header.bytes));
    }

    void pass(const PlyElement& element) {
        for (std::uint64_t i = 0; i < element.count; ++i)
            for (const PlyProperty& property : element.properties) {
                const std::uint64_t values =
                    property.list_count_bytes > 0 ? read_count(element, property.list_count_bytes) : 1;
                skip(element, values * static_cast<std::uint64_t>(property.value_bytes));
            }
    }

  private:
    void skip(const PlyElement& element, std::uint64_t bytes) {
        if (bytes > left_) fail_short(file_, element);
        left_ -= bytes;
        stream_.ignore(static_cast<std::streamsize>(bytes));
    }

    std::uint64_t read_count(const PlyElement& element, int bytes) {
        if (static_cast<std::uint64_t>(bytes) > left_) fail_short(file_, element);
        left_ -= static_cast<std::uint64_t>(bytes);
        std::uint64_t count = 0;
        for (int i = 0; i < bytes; ++i) {
            const auto byte = static_cast<std::uint64_t>(stream_.get() & 0xff);
            count = big_endian_ ? count << 8 | byte : count | byte << (8 * i);
        }
        if (count > file_.bytes) fail_short(file_, element);
        return count;
    }

    const File& file_;
    std::ifstream stream_;
    std::uint64_t left_;
    bool big_endian_;
};

/// A row of a text file: as many numbers as its element has.
bool is_row(const char* at, const PlyElement& element) {
    const auto take = [&](double& value) {
        char* end = nullptr;
        value = std::strtod(at, &end);
        const bool is_number = end != at && (*end == '\0' || *end == ' ' || *end == '\t' || *end == '\r');
        at = end;
        return is_number;
    };
    double value = 0;
    for (const PlyProperty& property : element.properties) {
        double count = 1;
        if (property.list_count_bytes > 0 && !(take(count) && count >= 0 && count <= longest_line))
            return false;
        for (int i = 0; i < static_cast<int>(count); ++i)
            if (!take(value)) return false;
    }
    return true;
}

void check_lines(const File& file, const PlyHeader& header) {
    check_text(file);
    std::ifstream stream(file.path, std::ios::binary);
    stream.seekg(static_cast<std::streamoff>(header.bytes));
    std::string line(longest_line, '\0');
    for (const PlyElement& element : header.elements)
        for (std::uint64_t i = 0; i < element.count; ++i) {
            if (stream.peek() == std::ifstream::traits_type::eof()) fail_short(file, element);
            stream.getline(line.data(), longest_line);
            if (!stream || !is_row(line.c_str(), element))
                file.fail(fmt::format("row {} of \"{}\" is not as its header says", i,
                                      shortened(printable(element.name), 40)));
        }
}

}  // namespace

void check_ply(const File& file) {
    const PlyHeader header = read_header(file);
    if (header.encoding == "ascii") return check_lines(file, header);
    if (header.encoding != "binary_little_endian" && header.encoding != "binary_big_endian")
        file.fail(fmt::format("its format is \"{}\"; allowed: ascii, binary_little_endian, binary_big_endian",
                              shortened(printable(header.encoding), 40)));
    PlyWalk walk(file, header);
    for (const PlyElement& element : header.elements) walk.pass(element);
}

}  // namespace ptb::mesh_formats
