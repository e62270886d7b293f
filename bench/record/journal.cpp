#include "bench/record/journal.h"

#include <cerrno>
#include <cstring>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>

#include "bench/record/file.h"
#include "bench/record/json.h"

namespace ptb {
namespace {

std::string line_of(const Json& json) { return dump_json(json) + "\n"; }

std::string journal_text(const ResultFile& result) {
    ResultFile header = result;
    header.cases.clear();
    std::string text = line_of(result_to_json(header));
    for (const Record& record : result.cases) text += line_of(encode(record));
    return text;
}

std::string_view take_line(std::string_view& text) {
    const auto line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    return line;
}

Record parse_record(std::string_view line, const std::string& origin) {
    Record record;
    decode(parse_json(line, origin), Where(origin), record);
    return record;
}

}  // namespace

Journal::Journal(std::filesystem::path file, const ResultFile& so_far) : file_(std::move(file)) {
    write_file(file_, journal_text(so_far));
    stream_.reset(std::fopen(file_.c_str(), "ab"));
    if (!stream_) throw std::runtime_error("cannot write " + file_.string() + ": " + std::strerror(errno));
}

void Journal::append(const Record& record) {
    const auto line = line_of(encode(record));
    const bool written = std::fwrite(line.data(), 1, line.size(), stream_.get()) == line.size();
    if (!written || std::fflush(stream_.get()) != 0)
        throw std::runtime_error("cannot write " + file_.string() + ": " + std::strerror(errno));
    synced_ = false;
}

void Journal::sync() {
    if (!synced_)
        ::fdatasync(::fileno(stream_.get()));  // where it cannot, nothing is lost that was not before
    synced_ = true;
}

JournalReader::JournalReader(std::istream& in, std::string origin) : in_(in), origin_(std::move(origin)) {
    std::string line;
    std::getline(in_, line);
    header_ = result_from_json(parse_json(line, origin_), origin_);
}

std::optional<Record> JournalReader::next() {
    std::string line;
    if (!std::getline(in_, line)) return std::nullopt;
    const bool cut_short = in_.eof();
    try {
        return parse_record(line, origin_ + ":" + std::to_string(++line_));
    } catch (const UsageError&) {
        if (!cut_short) throw;
    }
    return std::nullopt;
}

std::ifstream open_journal(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    if (!in) throw UsageError(fmt::format("{}: cannot be read: {}", file.string(), std::strerror(errno)));
    return in;
}

ResultFile parse_journal(std::string_view text, const std::string& origin) {
    std::istringstream in{std::string(text)};
    JournalReader reader(in, origin);
    ResultFile result = reader.header();
    while (auto record = reader.next()) result.cases.push_back(std::move(*record));
    return result;
}

bool is_journal(std::string_view text) {
    const auto first = take_line(text);
    return text.find_first_not_of(" \t\r\n") != std::string_view::npos && Json::accept(first);
}

ResultFile read_run(const std::filesystem::path& file) {
    const std::string text = read_text(file);
    if (is_journal(text)) return parse_journal(text, file.string());
    return result_from_json(parse_json(text, file.string()), file.string());
}

}  // namespace ptb
