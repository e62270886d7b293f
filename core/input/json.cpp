#include "core/input/json.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <limits>
#include <set>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/input/nearest.h"
#include "core/input/printable.h"
#include "core/input/usage_error.h"

namespace ptb {
namespace {

constexpr std::size_t deepest = 64;
constexpr std::size_t most_keys = 10'000;  ///< per object: looking one up is linear

/// nlohmann's message without its "[json.exception...] ".
std::string plain_message(const std::exception& error) {
    const std::string message = error.what();
    const auto end = message.find("] ");
    return shortened(printable(end == std::string::npos ? message : message.substr(end + 2)), 200);
}

/// Builds a document value by value, a step each, and refuses what is well-formed but hostile or ambiguous.
/// (nlohmann's own parser with a callback looks through all of a container after each of its elements.)
class Builder : public nlohmann::json_sax<Json> {
  public:
    explicit Builder(const std::string& origin) : origin_(origin) {}
    Json take() { return std::move(root_); }

    bool null() override { return add(nullptr); }
    bool boolean(bool value) override { return add(value); }
    bool number_integer(number_integer_t value) override { return add(value); }
    bool number_unsigned(number_unsigned_t value) override { return add(value); }
    bool number_float(number_float_t value, const string_t&) override { return add(value); }
    bool string(string_t& value) override { return add(std::move(value)); }
    bool binary(binary_t& value) override { return add(std::move(value)); }
    bool start_object(std::size_t) override { return open(Json::object()); }
    bool end_object() override { return close(); }
    bool start_array(std::size_t) override { return open(Json::array()); }
    bool end_array() override { return close(); }

    bool key(string_t& value) override {
        std::set<std::string>& keys = open_.back().keys;
        if (!keys.insert(value).second)
            fail(fmt::format("key \"{}\" comes twice in an object", shortened(printable(value), 40)));
        if (keys.size() > most_keys) fail(fmt::format("more than {} keys in an object", most_keys));
        key_ = std::move(value);
        return true;
    }

    bool parse_error(std::size_t, const std::string&, const Json::exception& error) override {
        fail("not JSON: " + plain_message(error));
    }

  private:
    /// An array or object whose end has not come.
    struct Container {
        Json* json;
        std::set<std::string> keys;
    };

    bool add(Json value) {
        place(std::move(value));
        return true;
    }

    bool open(Json container) {
        if (open_.size() == deepest) fail(fmt::format("nested deeper than {} levels", deepest));
        Json& placed = place(std::move(container));
        open_.push_back({&placed, {}});
        return true;
    }

    bool close() {
        open_.pop_back();
        return true;
    }

    /// At the end of the innermost container, whose keys are known to differ.
    Json& place(Json value) {
        if (open_.empty()) return root_ = std::move(value);
        Json& parent = *open_.back().json;
        if (parent.is_array()) return parent.get_ref<Json::array_t&>().emplace_back(std::move(value));
        return parent.get_ref<Json::object_t&>().emplace_back(std::move(key_), std::move(value)).second;
    }

    [[noreturn]] void fail(const std::string& message) const { throw UsageError(origin_ + ": " + message); }

    const std::string& origin_;
    Json root_;
    std::string key_;  ///< of the member that comes
    std::vector<Container> open_;
};

template <class Int>
void decode_integer(const Json& json, const Where& where, Int& value) {
    constexpr auto least = std::numeric_limits<Int>::min();
    constexpr auto most = std::numeric_limits<Int>::max();
    const bool fits = json.is_number_unsigned()  ? std::in_range<Int>(json.get<std::uint64_t>())
                      : json.is_number_integer() ? std::in_range<Int>(json.get<std::int64_t>())
                                                 : false;
    if (!fits) where.refuse(json, fmt::format("an integer from {} to {}", least, most));
    value = json.is_number_unsigned() ? static_cast<Int>(json.get<std::uint64_t>())
                                      : static_cast<Int>(json.get<std::int64_t>());
}

}  // namespace

std::string Where::pointer() const {
    if (parent_ == nullptr) return {};
    if (key_.data() == nullptr) return parent_->pointer() + "/" + std::to_string(index_);
    std::string escaped;
    for (const char c : shortened(printable(key_), 40)) {
        if (c == '~')
            escaped += "~0";
        else if (c == '/')
            escaped += "~1";
        else
            escaped += c;
    }
    return parent_->pointer() + "/" + escaped;
}

std::string Where::text() const {
    const Where* root = this;
    while (root->parent_ != nullptr) root = root->parent_;
    const auto path = pointer();
    return path.empty() ? *root->origin_ : *root->origin_ + ": " + path;
}

void Where::fail(const std::string& message) const { throw UsageError(text() + ": " + message); }

void Where::refuse(const Json& found, const std::string& allowed) const {
    const bool container = found.is_structured() && !found.empty();
    const auto shown = container ? std::string("an ") + found.type_name() : dump_json(found);
    fail(fmt::format("found {}; allowed: {}", shortened(printable(shown), 60), allowed));
}

Json parse_json(std::string_view text, const std::string& origin) {
    Builder builder(origin);
    Json::sax_parse(text, &builder);
    return builder.take();
}

std::string read_text(const std::filesystem::path& file) {
    const auto fail = [&](const std::string& why) {
        throw UsageError("cannot read " + file.string() + ": " + why);
    };
    std::error_code error;
    if (std::filesystem::is_directory(file, error)) fail("it is a folder");
    errno = 0;
    std::ifstream stream(file, std::ios::binary);
    if (!stream) fail(std::strerror(errno));
    const auto bytes = std::filesystem::file_size(file, error);  // of a pipe nobody knows
    bool too_large = !error && bytes > most_text;
    std::string text;
    for (std::string block(1 << 16, '\0'); stream && !too_large; too_large = text.size() > most_text) {
        stream.read(block.data(), static_cast<std::streamsize>(block.size()));
        text.append(block, 0, static_cast<std::size_t>(stream.gcount()));
    }
    if (stream.bad()) fail(std::strerror(errno));
    if (too_large) fail(fmt::format("it is larger than {} MiB", most_text >> 20));
    return text;
}

const Json& member(const Json& object, const Where& where, const std::string& key) {
    if (!object.is_object()) where.refuse(object, "an object");
    const auto found = object.find(key);
    if (found == object.end()) where.fail(fmt::format("\"{}\" is missing", key));
    return *found;
}

void refuse_key(const std::string& key, const Where& where, const std::vector<std::string>& known) {
    const std::string hint = did_you_mean(key, known);
    Where(where, key)
        .fail("unknown key" + (hint.empty() ? fmt::format("; allowed: {}", fmt::join(known, ", ")) : hint));
}

void allow_only(const Json& object, const Where& where, const std::vector<std::string>& known) {
    if (!object.is_object()) where.refuse(object, "an object");
    for (const auto& [key, value] : object.items())
        if (std::find(known.begin(), known.end(), key) == known.end()) refuse_key(key, where, known);
}

std::string dump_json(const Json& json, int indent) {
    return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

void decode(const Json& json, const Where& where, bool& value) {
    if (!json.is_boolean()) where.refuse(json, "true or false");
    value = json.get<bool>();
}

void decode(const Json& json, const Where& where, int& value) { decode_integer(json, where, value); }
void decode(const Json& json, const Where& where, std::int64_t& value) { decode_integer(json, where, value); }
void decode(const Json& json, const Where& where, std::uint64_t& value) {
    decode_integer(json, where, value);
}

void decode(const Json& json, const Where& where, double& value) {
    if (!json.is_number() && !json.is_null()) where.refuse(json, "a number");
    value = json.is_null() ? std::numeric_limits<double>::quiet_NaN() : json.get<double>();
}

void decode(const Json& json, const Where& where, std::string& value) {
    if (!json.is_string()) where.refuse(json, "a string");
    value = json.get<std::string>();
}

}  // namespace ptb
