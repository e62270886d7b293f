#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

namespace ptb {

/// JSON whose objects keep the order of their keys.
using Json = nlohmann::ordered_json;

/// Where in a document something is: a chain of keys and indices up to the document's origin.
class Where {
  public:
    /// Keeps a reference: `origin` must outlive it.
    explicit Where(const std::string& origin) : origin_(&origin) {}
    explicit Where(std::string&&) = delete;
    Where(const Where& parent, std::string_view key) : parent_(&parent), key_(key) {}
    Where(const Where& parent, std::size_t index) : parent_(&parent), index_(index) {}
    /// "file.json: /series/0/spp", a JSON pointer after the origin.
    std::string text() const;
    /// Throws UsageError "file.json: /series/0/spp: message".
    [[noreturn]] void fail(const std::string& message) const;
    /// Fails with what was found (shortened) and what is allowed.
    [[noreturn]] void refuse(const Json& found, const std::string& allowed) const;

  private:
    std::string pointer() const;
    const std::string* origin_ = nullptr;
    const Where* parent_ = nullptr;
    std::string_view key_;
    std::size_t index_ = 0;
};

/// Parses text that nobody vouches for: depth and keys per object are bounded, a key may not come twice.
/// Throws UsageError with `origin`, on one line.
Json parse_json(std::string_view text, const std::string& origin);

/// Bytes of the largest text that is read.
inline constexpr std::uintmax_t most_text = std::uintmax_t{256} << 20;

/// The whole file; throws UsageError when it cannot be read, or is larger than `most_text`.
std::string read_text(const std::filesystem::path& file);

/// A member of an object. Throws UsageError when `object` is none, or has no such member.
const Json& member(const Json& object, const Where& where, const std::string& key);

/// Refuses a key that is not known, naming the nearest one or all of them.
[[noreturn]] void refuse_key(const std::string& key, const Where& where,
                             const std::vector<std::string>& known);

/// An object with no other keys than these.
void allow_only(const Json& object, const Where& where, const std::vector<std::string>& known);

/// JSON on one line, or indented by `indent` spaces; bytes that are not UTF-8 are replaced.
std::string dump_json(const Json& json, int indent = -1);

/// Strict readers: the JSON type must be the right one, and the number must fit. They throw UsageError.
void decode(const Json& json, const Where& where, bool& value);
void decode(const Json& json, const Where& where, int& value);
void decode(const Json& json, const Where& where, std::int64_t& value);
void decode(const Json& json, const Where& where, std::uint64_t& value);
/// null, which is what is written for a number that is not finite, becomes NaN.
void decode(const Json& json, const Where& where, double& value);
void decode(const Json& json, const Where& where, std::string& value);

}  // namespace ptb
