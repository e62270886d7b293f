#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>
#include <map>
#include <vector>

#include <fmt/format.h>

#include "core/input/base64.h"
#include "core/input/json_node.h"
#include "core/input/printable.h"
#include "core/input/usage_error.h"
#include "core/mesh/formats.h"

namespace ptb::mesh_formats {
namespace {

constexpr std::uintmax_t most_bytes = std::uintmax_t{1}
                                      << 30;  ///< of all buffers; a GLB chunk tells its size in 32 bits
constexpr std::uint32_t json_chunk = 0x4E4F534A, bin_chunk = 0x004E4942;
constexpr int deepest_node = 64;

std::uint32_t word_at(const std::string& bytes, std::size_t offset) {
    std::uint32_t word = 0;
    if (offset + 4 <= bytes.size()) std::memcpy(&word, &bytes[offset], 4);
    return word;
}

std::string word(std::uint64_t value) {
    const auto low = static_cast<std::uint32_t>(value);
    return {reinterpret_cast<const char*>(&low), 4};
}

/// A file's text, and the buffer that comes with it in a GLB.
struct Document {
    std::string text, bin;
};

Document open_glb(const File& file) {
    const std::string bytes = file.part(0, file.bytes);
    if (!bytes.starts_with("glTF") || word_at(bytes, 4) != 2) file.fail("it is no GLB of version 2");
    if (word_at(bytes, 8) != bytes.size())
        file.fail(fmt::format("it has {} bytes, and says that it has {}", bytes.size(), word_at(bytes, 8)));
    Document document;
    for (std::size_t at = 12; at < bytes.size();) {
        const std::size_t length = word_at(bytes, at);
        const std::uint32_t type = word_at(bytes, at + 4);
        if (at + 8 > bytes.size() || length > bytes.size() - at - 8) file.fail("a chunk of it is cut off");
        if (type == json_chunk && document.text.empty()) document.text = bytes.substr(at + 8, length);
        if (type == bin_chunk && document.bin.empty()) document.bin = bytes.substr(at + 8, length);
        at += 8 + length;
    }
    return document;
}

Document document_of(const File& file) {
    if (file.bytes > most_bytes) file.fail(fmt::format("it is larger than {} MiB", most_bytes >> 20));
    if (file.part(0, 4) == "glTF") return open_glb(file);
    check_text(file);
    return {file.part(0, file.bytes), {}};
}

constexpr const char* allowed_buffers = "a file in this one's folder or below, or data in base64";

/// "%20" is a space: see RFC 3986, "Uniform Resource Identifier (URI): Generic Syntax".
std::string decoded(const JsonNode& node, const std::string& uri) {
    std::string text;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        if (uri[i] != '%') {
            text += uri[i];
            continue;
        }
        unsigned char byte = 0;
        const char* const first = uri.data() + i + 1;
        const auto [end, error] =
            std::from_chars(first, std::min(first + 2, uri.data() + uri.size()), byte, 16);
        if (error != std::errc() || end != first + 2 || byte == 0)
            node.refuse("two hexadecimal digits, not 00, after each %");
        text += static_cast<char>(byte);
        i += 2;
    }
    return text;
}

/// The file that a buffer's URI names, which is not to lead out of the document's folder.
std::filesystem::path file_of(const File& document, const JsonNode& node, const std::string& uri) {
    const std::filesystem::path relative = decoded(node, uri);
    if (relative.is_absolute() || std::find(relative.begin(), relative.end(), "..") != relative.end())
        node.refuse(allowed_buffers);
    return document.path.parent_path() / relative;
}

/// An index into a list of the document.
std::size_t index(const JsonNode& node, const JsonNode& of) {
    if (of.json.empty()) node.refuse("nothing, since that list is empty");
    return node.integer(0, of.size() - 1);
}

std::uint64_t integer_or(const JsonNode& parent, const std::string& key, std::uint64_t otherwise) {
    return parent.has(key) ? parent.at(key).integer(0, most_bytes) : otherwise;
}

/// Puts together what of a document is geometry: the same numbers of accessors, meshes and nodes, and one
/// buffer.
class BareDocument {
  public:
    BareDocument(const File& file, const Document& document, const JsonNode& root)
        : file_(file), document_(document), root_(root) {
        bare_["asset"] = {{"version", "2.0"}};
        check_extensions();
        add_buffers();
        add_views();
        add_accessors();
        add_meshes();
        add_nodes();
        add_scenes();
    }

    std::string glb() const {
        std::string text = dump_json(bare_), bin = bin_;
        text.resize((text.size() + 3) / 4 * 4, ' ');
        bin.resize((bin.size() + 3) / 4 * 4, '\0');
        const std::string chunks =
            word(text.size()) + word(json_chunk) + text + word(bin.size()) + word(bin_chunk) + bin;
        return "glTF" + word(2) + word(12 + chunks.size()) + chunks;
    }

  private:
    /// Some change what triangles there are.
    void check_extensions() {
        if (!root_.has("extensionsRequired")) return;
        const JsonNode required = root_.list("extensionsRequired");
        for (std::size_t i = 0; i < required.size(); ++i) {
            const std::string name = required.at(i).text("the name of an extension");
            if (!name.starts_with("KHR_materials_") && !name.starts_with("KHR_texture_"))
                required.at(i).refuse("extensions of materials and textures alone");
        }
    }

    void add_buffers() {
        const JsonNode buffers = root_.list("buffers");
        for (std::size_t i = 0; i < buffers.size(); ++i) {
            const JsonNode buffer = buffers.at(i);
            const std::string bytes = bytes_of(buffer);
            const std::uint64_t length = buffer.at("byteLength").integer(1, most_bytes);
            if (length > bytes.size())
                buffer.at("byteLength")
                    .refuse(fmt::format("at most the {} bytes that there are", bytes.size()));
            if (bin_.size() + length > most_bytes)
                buffer.where.fail(fmt::format("buffers of more than {} MiB", most_bytes >> 20));
            bin_.resize((bin_.size() + 3) / 4 * 4, '\0');
            buffer_starts_.push_back(bin_.size());
            buffer_lengths_.push_back(length);
            bin_.append(bytes, 0, length);
        }
        bare_["buffers"] = {{{"byteLength", bin_.size()}}};
    }

    std::string bytes_of(const JsonNode& buffer) const {
        if (!buffer.has("uri")) return document_.bin;
        const JsonNode node = buffer.at("uri");
        const std::string uri = node.text("the URI of a buffer");
        if (uri.starts_with("data:")) return from_data(node, uri);
        std::error_code error;
        File beside{file_of(file_, node, uri)};
        beside.bytes = std::filesystem::file_size(beside.path, error);
        if (error || !std::filesystem::is_regular_file(beside.path)) node.refuse(allowed_buffers);
        if (beside.bytes > most_bytes)
            node.where.fail(fmt::format("a file of more than {} MiB", most_bytes >> 20));
        return beside.part(0, beside.bytes);
    }

    static std::string from_data(const JsonNode& node, const std::string& uri) {
        const std::string mark = ";base64,";
        const auto at = uri.find(mark);
        if (at == std::string::npos) node.refuse("data in base64");
        try {
            return from_base64(std::string_view(uri).substr(at + mark.size()));
        } catch (const UsageError&) {
            node.refuse("data in base64");
        }
    }

    void add_views() {
        bare_["bufferViews"] = Json::array();
        const JsonNode views = root_.list("bufferViews");
        for (std::size_t i = 0; i < views.size(); ++i) {
            const JsonNode view = views.at(i);
            const std::size_t buffer = index(view.at("buffer"), root_.at("buffers"));
            const std::uint64_t offset = integer_or(view, "byteOffset", 0);
            const std::uint64_t length = view.at("byteLength").integer(1, most_bytes);
            if (offset + length > buffer_lengths_[buffer])
                view.where.fail(fmt::format(
                    "found {} bytes from {} on; allowed: what is within the {} bytes of buffer {}", length,
                    offset, buffer_lengths_[buffer], buffer));
            Json bare = {
                {"buffer", 0}, {"byteOffset", buffer_starts_[buffer] + offset}, {"byteLength", length}};
            if (view.has("byteStride")) bare["byteStride"] = view.at("byteStride").integer(4, 252);
            bare_["bufferViews"].push_back(bare);
        }
    }

    void add_accessors() {
        bare_["accessors"] = Json::array();
        const JsonNode accessors = root_.list("accessors");
        for (std::size_t i = 0; i < accessors.size(); ++i)
            bare_["accessors"].push_back(bare_accessor(accessors.at(i)));
    }

    Json bare_accessor(const JsonNode& accessor) const {
        static const std::map<std::string, std::uint64_t> widths = {
            {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT2", 4}, {"MAT3", 9}, {"MAT4", 16}};
        static const std::array<std::uint64_t, 7> type_bytes = {1, 1, 2, 2, 0, 4, 4};
        if (accessor.has("sparse"))
            accessor.at("sparse").where.fail("found sparse values; allowed: whole ones");
        const auto width = widths.find(accessor.at("type").text("a type of accessor"));
        if (width == widths.end()) accessor.at("type").refuse("a type of accessor");
        const std::uint64_t component = accessor.at("componentType").integer(5120, 5126);
        const std::uint64_t bytes = type_bytes[component - 5120] * width->second;
        if (bytes == 0) accessor.at("componentType").refuse("5120 to 5123, 5125 or 5126");
        const std::size_t number = index(accessor.at("bufferView"), root_.at("bufferViews"));
        const Json& view = bare_["bufferViews"][number];
        const std::uint64_t offset = integer_or(accessor, "byteOffset", 0);
        const std::uint64_t count = accessor.at("count").integer(1, most_bytes);
        const std::uint64_t stride =
            view.contains("byteStride") ? view["byteStride"].get<std::uint64_t>() : bytes;
        if (offset + (count - 1) * stride + bytes > view["byteLength"].get<std::uint64_t>())
            accessor.where.fail(fmt::format(
                "found {} values of {} bytes; allowed: what is within bufferView {}", count, bytes, number));
        return {{"bufferView", number},
                {"byteOffset", offset},
                {"componentType", component},
                {"count", count},
                {"type", width->first}};
    }

    void add_meshes() {
        bare_["meshes"] = Json::array();
        const JsonNode meshes = root_.list("meshes");
        for (std::size_t i = 0; i < meshes.size(); ++i) {
            const JsonNode mesh = meshes.at(i);
            const JsonNode primitives = mesh.list("primitives");
            Json bare = Json::array();
            for (std::size_t k = 0; k < primitives.size(); ++k)
                bare.push_back(bare_primitive(primitives.at(k)));
            bare_["meshes"].push_back({{"primitives", bare}});
        }
    }

    Json bare_primitive(const JsonNode& primitive) const {
        const JsonNode accessors = root_.at("accessors");
        const JsonNode attributes = primitive.at("attributes");
        const JsonNode position = attributes.at("POSITION");
        const std::size_t number = index(position, accessors);
        const Json& values = bare_["accessors"][number];
        if (values["type"] != "VEC3" || values["componentType"] != 5126)
            position.refuse("an accessor of floats, VEC3");
        Json bare = {{"attributes", {{"POSITION", number}}},
                     {"mode", primitive.has("mode") ? primitive.at("mode").integer(0, 6) : 4}};
        if (primitive.has("indices")) bare["indices"] = bare_indices(primitive.at("indices"), accessors);
        return bare;
    }

    std::size_t bare_indices(const JsonNode& node, const JsonNode& accessors) const {
        const std::size_t number = index(node, accessors);
        const Json& values = bare_["accessors"][number];
        const int component = values["componentType"].get<int>();
        if (values["type"] != "SCALAR" || (component != 5121 && component != 5123 && component != 5125))
            node.refuse("an accessor of whole numbers, SCALAR");
        return number;
    }

    void add_nodes() {
        bare_["nodes"] = Json::array();
        const JsonNode nodes = root_.list("nodes");
        parents_.assign(nodes.size(), -1);
        for (std::size_t i = 0; i < nodes.size(); ++i) bare_["nodes"].push_back(bare_node(nodes, i));
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            int depth = 0;
            for (int at = static_cast<int>(i); at >= 0 && depth <= deepest_node;
                 at = parents_[static_cast<std::size_t>(at)])
                ++depth;
            if (depth > deepest_node)
                nodes.at(i).where.fail(fmt::format(
                    "it is below itself, or deep down; allowed: a tree of at most {} levels", deepest_node));
        }
    }

    Json bare_node(const JsonNode& nodes, std::size_t number) {
        const JsonNode node = nodes.at(number);
        Json bare = Json::object();
        if (node.has("mesh")) bare["mesh"] = index(node.at("mesh"), root_.at("meshes"));
        for (const auto& [key, count] : {std::pair("matrix", 16U), std::pair("translation", 3U),
                                         std::pair("rotation", 4U), std::pair("scale", 3U)})
            if (node.has(key)) bare[key] = numbers(node.at(key), count);
        if (!node.has("children")) return bare;
        const JsonNode children = node.list("children");
        bare["children"] = Json::array();
        for (std::size_t i = 0; i < children.size(); ++i) {
            const std::size_t child = index(children.at(i), nodes);
            if (parents_[child] >= 0) children.at(i).refuse("a node that is nobody else's child");
            parents_[child] = static_cast<int>(number);
            bare["children"].push_back(child);
        }
        return bare;
    }

    static Json numbers(const JsonNode& node, std::size_t count) {
        const auto is_number = [](const Json& each) { return each.is_number(); };
        if (!node.json.is_array() || node.size() != count ||
            !std::all_of(node.json.begin(), node.json.end(), is_number))
            node.refuse(fmt::format("{} numbers", count));
        return node.json;
    }

    /// The scene that is shown, of every root once.
    void add_scenes() {
        const JsonNode scenes = root_.list("scenes");
        if (scenes.json.empty()) scenes.refuse("at least one scene");
        const std::size_t shown = root_.has("scene") ? index(root_.at("scene"), scenes) : 0;
        const JsonNode scene = scenes.at(shown);
        const JsonNode roots = scene.list("nodes");
        std::vector<std::size_t> numbers_of_roots;
        for (std::size_t i = 0; i < roots.size(); ++i) {
            const std::size_t node = index(roots.at(i), root_.at("nodes"));
            if (parents_[node] >= 0) roots.at(i).refuse("a node that is nobody's child");
            parents_[node] = static_cast<int>(node);
            numbers_of_roots.push_back(node);
        }
        bare_["scenes"] = {{{"nodes", numbers_of_roots}}};
        bare_["scene"] = 0;
    }

    const File& file_;
    const Document& document_;
    const JsonNode& root_;
    Json bare_;
    std::string bin_;
    std::vector<std::uint64_t> buffer_starts_, buffer_lengths_;
    std::vector<int> parents_;  ///< of nodes, -1 for none
};

std::string origin_of(const File& file) {
    return fmt::format("cannot read {}", printable(file.path.string()));
}

}  // namespace

std::vector<std::filesystem::path> buffer_files(const File& file) {
    std::vector<std::filesystem::path> files;
    const std::string origin = origin_of(file);
    const Json json = parse_json(document_of(file).text, origin);
    const JsonNode root{json, Where(origin)};
    if (!root.has("buffers")) return files;
    const JsonNode buffers = root.list("buffers");
    for (std::size_t i = 0; i < buffers.size(); ++i) {
        const JsonNode buffer = buffers.at(i);
        if (!buffer.has("uri")) continue;
        const JsonNode uri = buffer.at("uri");
        const std::string text = uri.text("the URI of a buffer");
        if (!text.starts_with("data:")) files.push_back(file_of(file, uri, text));
    }
    return files;
}

std::string bare_glb(const File& file) {
    const Document document = document_of(file);
    const std::string origin = origin_of(file);
    const Json json = parse_json(document.text, origin);
    const JsonNode root{json, Where(origin)};
    const JsonNode asset = root.at("asset");
    const JsonNode version = asset.at("version");
    if (!version.text("\"2.0\"").starts_with("2.")) version.refuse("\"2.0\"");
    return BareDocument(file, document, root).glb();
}

}  // namespace ptb::mesh_formats
