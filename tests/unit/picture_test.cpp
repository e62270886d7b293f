#include "bench/worker/picture.h"

#include <numeric>

#include <gtest/gtest.h>

namespace ptb {
namespace {

/// Every number is another.
Image numbered(Size size) {
    Image image{size, std::vector<float>(3 * size.pixels())};
    std::iota(image.rgb.begin(), image.rgb.end(), 0.5F);
    return image;
}

struct Piece {
    int first_row;
    std::string rgb;
};

std::vector<Piece> pieces_of(const Image& image) {
    std::vector<Piece> pieces;
    send_rows(image, [&](int first_row, const std::string& rgb) { pieces.push_back({first_row, rgb}); });
    return pieces;
}

std::optional<Image> put_together(Size size, const std::vector<Piece>& pieces) {
    PictureInRows picture(size);
    for (const Piece& piece : pieces) picture.add(piece.first_row, piece.rgb);
    return picture.taken();
}

TEST(Picture, arrives_as_it_was_sent) {
    for (const Size size : {Size{1, 1}, Size{7, 5}, Size{640, 480}, Size{200'000, 2}}) {
        const Image image = numbered(size);
        EXPECT_EQ(put_together(size, pieces_of(image)), image);
    }
}

TEST(Picture, comes_in_pieces_of_whole_rows_that_fit_into_a_line) {
    const auto pieces = pieces_of(numbered({640, 480}));
    ASSERT_GT(pieces.size(), 1U);
    for (const Piece& piece : pieces) EXPECT_LE(piece.rgb.size(), std::size_t{2} << 20U);
}

TEST(Picture, what_is_missing_or_wrong_leaves_none) {
    const Size size{640, 480};
    const auto pieces = pieces_of(numbered(size));
    EXPECT_EQ(put_together(size, {}), std::nullopt);
    EXPECT_EQ(put_together(size, {pieces.begin(), pieces.end() - 1}), std::nullopt);
    EXPECT_EQ(put_together(size, {pieces.begin() + 1, pieces.end()}), std::nullopt);
    auto twice = pieces, garbled = pieces, torn = pieces;
    twice.insert(twice.begin(), pieces[0]);
    EXPECT_EQ(put_together(size, twice), std::nullopt);
    garbled[0].rgb[5] = '?';
    EXPECT_EQ(put_together(size, garbled), std::nullopt);
    torn[0].rgb.resize(16);
    EXPECT_EQ(put_together(size, torn), std::nullopt);
    EXPECT_EQ(put_together({640, 479}, pieces), std::nullopt);
}

}  // namespace
}  // namespace ptb
