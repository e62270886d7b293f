#include "bench/report/html/frame.h"

#include <fmt/format.h>

#include "bench/report/html/assets.h"
#include "bench/report/html/html.h"
#include "core/source/text_hash.h"

namespace ptb {
namespace {

std::string asset(std::string_view name) {
    for (const EmbeddedFile& file : embedded_page_files())
        if (file.name == name) return std::string(file.text);
    throw std::logic_error(fmt::format("{} is not embedded", name));
}

std::string script(const std::string& nonce, const std::string& text) {
    return fmt::format("<script nonce=\"{}\">\n{}</script>\n", nonce, text);
}

std::string data_scripts(const std::vector<std::string>& data) {
    std::string html;
    for (const std::string& text : data)
        html += fmt::format("<script type=\"application/octet-stream\" class=\"data\">{}</script>\n", text);
    return html;
}

}  // namespace

std::string framed(const std::string& title, const std::string& main, const std::vector<std::string>& data,
                   const std::vector<std::string>& scripts) {
    // Only these scripts run, and no text of a file that is shown can name what it is itself a part of.
    const std::string nonce = text_hash(title + main);
    std::string code;
    for (const std::string& name : scripts) code += script(nonce, asset(name));
    return filled(asset("page.html"), {{"NONCE", nonce},
                                       {"TITLE", html_text(title)},
                                       {"STYLE", asset("page.css")},
                                       {"MAIN", main},
                                       {"DATA", data_scripts(data)},
                                       {"SCRIPTS", code}});
}

std::string part(const std::string& id, const std::string& heading, const std::string& html) {
    if (html.empty()) return "";
    return fmt::format(
        "<section id=\"{}\" aria-labelledby=\"{}-h\">\n<h2 id=\"{}-h\">{}</h2>\n{}</section>\n", id, id, id,
        html_text(heading), html);
}

}  // namespace ptb
