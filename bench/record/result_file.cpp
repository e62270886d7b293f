#include "bench/record/result_file.h"

#include "bench/record/file.h"
#include "bench/record/json.h"

namespace ptb {

std::string result_text(const ResultFile& result) { return dump_json(result_to_json(result), 2) + "\n"; }

void write_result(const std::filesystem::path& file, const ResultFile& result) {
    write_file(file, result_text(result));
}

ResultFile read_result(const std::filesystem::path& file) {
    return result_from_json(parse_json(read_text(file), file.string()), file.string());
}

}  // namespace ptb
