#include "core/render/film_hash.h"

#include <set>
#include <vector>

#include <gtest/gtest.h>

namespace ptb {
namespace {

std::string hash_of(const std::vector<std::uint64_t>& words) {
    FilmHash hash;
    hash.add(std::span<const std::uint64_t>(words));
    return hash.text();
}

TEST(FilmHash, any_one_bit_changes_it) {
    const std::vector<std::uint64_t> film(64, 7);
    std::set<std::string> hashes{hash_of(film)};
    for (std::size_t word = 0; word < film.size(); ++word)
        for (int bit = 0; bit < 64; ++bit) {
            auto changed = film;
            changed[word] ^= std::uint64_t{1} << bit;
            hashes.insert(hash_of(changed));
        }
    EXPECT_EQ(hashes.size(), 1 + 64 * 64u);
}

TEST(FilmHash, does_not_depend_on_the_pieces) {
    const std::vector<std::uint64_t> film{1, 2, 3, 4, 5};
    FilmHash hash;
    hash.add(std::span(film).first(2));
    hash.add(std::span(film).last(3));
    EXPECT_EQ(hash.text(), hash_of(film));
    EXPECT_EQ(hash.text().size(), 16u);
    EXPECT_NE(hash_of({2, 1, 3, 4, 5}), hash.text()) << "the order of pixels matters";
}

}  // namespace
}  // namespace ptb
