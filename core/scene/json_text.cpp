#include "core/scene/json_text.h"

#include <algorithm>
#include <set>
#include <vector>

#include <fmt/format.h>

#include "core/scene/scene.h"

namespace ptb {
namespace {

constexpr std::size_t most_nesting = 64;

/// Reads the text once without building anything, so that a hostile one is refused before it costs memory or
/// stack.
class JsonChecker : public nlohmann::json_sax<nlohmann::json> {
  public:
    JsonChecker(std::string_view text, const std::string& origin) : text_(text), origin_(origin) {}

    bool null() override { return true; }
    bool boolean(bool) override { return true; }
    bool number_integer(number_integer_t) override { return true; }
    bool number_unsigned(number_unsigned_t) override { return true; }
    bool number_float(number_float_t, const string_t&) override { return true; }
    bool string(string_t&) override { return true; }
    bool binary(binary_t&) override { return true; }
    bool start_object(std::size_t) override { return descend(); }
    bool start_array(std::size_t) override { return descend(); }
    bool end_object() override { return ascend(); }
    bool end_array() override { return ascend(); }

    bool key(string_t& name) override {
        if (!keys_.back().insert(name).second)
            throw SceneError(fmt::format("{}: the key {} appears twice in one object", origin_, shown(name)));
        return true;
    }

    bool parse_error(std::size_t position, const std::string&,
                     const nlohmann::json::exception& error) override {
        const std::string what = error.what();
        const std::size_t reason = what.rfind(": ", what.find(" - "));  // behind "[...] parse error at ...: "
        const std::string_view before = text_.substr(0, position > 0 ? position - 1 : 0);
        const auto line = std::count(before.begin(), before.end(), '\n') + 1;
        const std::size_t column = before.size() - (before.rfind('\n') + 1) + 1;
        throw SceneError(fmt::format("{}:{}:{}: {}", origin_, line, column,
                                     reason == std::string::npos ? what : what.substr(reason + 2)));
    }

  private:
    bool descend() {
        keys_.emplace_back();
        if (keys_.size() > most_nesting)
            throw SceneError(fmt::format("{}: nested more than {} deep", origin_, most_nesting));
        return true;
    }
    bool ascend() {
        keys_.pop_back();
        return true;
    }

    std::string_view text_;
    const std::string& origin_;
    std::vector<std::set<std::string>> keys_;  ///< of each object (or array) that is open
};

}  // namespace

nlohmann::json parse_scene_json(std::string_view text, const std::string& origin) {
    JsonChecker checker(text, origin);
    nlohmann::json::sax_parse(text, &checker);
    return nlohmann::json::parse(text);
}

std::string shown(const nlohmann::json& value, std::size_t most_letters) {
    std::string text = value.dump(-1, ' ', true);
    if (text.size() > most_letters) text = text.substr(0, most_letters - 3) + "...";
    return text;
}

}  // namespace ptb
