#include "bench/worker/film_file.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <span>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include "bench/record/film_json.h"
#include "core/render/film_hash.h"

namespace ptb {

/// The first line of a film's file.
struct FilmHeader {
    std::string schema;
    FilmFacts film;
    std::string hash;  ///< of its pixels: a folder may damage a file and keep its size
};

template <>
inline constexpr auto fields<FilmHeader> = std::make_tuple(required("schema", &FilmHeader::schema),
                                                           required("film", &FilmHeader::film),
                                                           required("hash", &FilmHeader::hash));

namespace {

namespace fs = std::filesystem;

constexpr const char* film_schema = "ptbench.film.v2";

std::string hash_of(const FilmSums& sums) {
    FilmHash hash;
    hash.add(std::span<const FilmPixel>(sums.pixels));
    return hash.text();
}

[[noreturn]] void fail(const fs::path& file, const std::string& reason) {
    throw std::runtime_error(fmt::format("{}: {}", file.string(), reason));
}

std::streamsize bytes_of(const FilmSums& sums) {
    return static_cast<std::streamsize>(sums.pixels.size() * sizeof(FilmPixel));
}

FilmHeader read_header(const std::string& line, const fs::path& file) {
    FilmHeader header;
    const std::string origin = file.string();
    decode(parse_json(line, origin), Where(origin), header);
    if (header.schema != film_schema) fail(file, "is no film");
    return header;
}

}  // namespace

void write_film(const fs::path& file, const FilmSums& sums) {
    std::ofstream out(file, std::ios::binary);
    out << dump_json(encode(FilmHeader{film_schema, sums.facts, hash_of(sums)})) << '\n';
    out.write(reinterpret_cast<const char*>(sums.pixels.data()), bytes_of(sums));
    out.close();
    if (!out) fail(file, std::string("cannot be written: ") + std::strerror(errno));
}

FilmSums read_film(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::string line;
    if (!std::getline(in, line)) fail(file, "cannot be read");
    const FilmHeader header = read_header(line, file);
    FilmSums sums{header.film};
    const auto bytes = static_cast<std::uintmax_t>(header.film.size.pixels()) * sizeof(FilmPixel);
    if (fs::file_size(file) != line.size() + 1 + bytes) fail(file, "is not a whole film");
    sums.pixels.resize(header.film.size.pixels());
    if (!in.read(reinterpret_cast<char*>(sums.pixels.data()), bytes_of(sums))) fail(file, "cannot be read");
    if (hash_of(sums) != header.hash) fail(file, "is damaged: its hash is not that of its first line");
    return sums;
}

}  // namespace ptb
