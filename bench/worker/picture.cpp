#include "bench/worker/picture.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "core/input/base64.h"
#include "core/input/usage_error.h"

namespace ptb {
namespace {

constexpr std::size_t floats_a_piece = std::size_t{1} << 18U;

std::size_t floats_a_row(const Image& image) { return 3 * static_cast<std::size_t>(image.size.width); }

/// The floats in base64 text, or none when it is none of floats.
std::vector<float> floats_of(const std::string& text) {
    std::vector<float> floats;
    try {
        const std::string bytes = from_base64(text);
        if (bytes.size() % sizeof(float) != 0) return floats;
        floats.resize(bytes.size() / sizeof(float));
        std::memcpy(floats.data(), bytes.data(), bytes.size());
    } catch (const UsageError&) {
    }
    return floats;
}

}  // namespace

void send_rows(const Image& image, const std::function<void(int first_row, const std::string& rgb)>& send) {
    const std::size_t row = floats_a_row(image), rows = static_cast<std::size_t>(image.size.height);
    const std::size_t step = std::max<std::size_t>(floats_a_piece / std::max<std::size_t>(row, 1), 1);
    for (std::size_t first = 0; first < rows; first += step) {
        const std::size_t count = std::min(step, rows - first) * row;
        const auto* const bytes = reinterpret_cast<const char*>(image.rgb.data() + first * row);
        send(static_cast<int>(first), base64({bytes, count * sizeof(float)}));
    }
}

void PictureInRows::add(int first_row, const std::string& rgb) {
    const std::vector<float> floats = floats_of(rgb);
    const std::size_t row = floats_a_row(image_), whole = 3 * image_.size.pixels();
    const bool follows = first_row >= 0 && static_cast<std::size_t>(first_row) * row == image_.rgb.size();
    const bool fits =
        !floats.empty() && floats.size() % row == 0 && image_.rgb.size() + floats.size() <= whole;
    spoiled_ = spoiled_ || !follows || !fits;
    if (!spoiled_) image_.rgb.insert(image_.rgb.end(), floats.begin(), floats.end());
}

std::optional<Image> PictureInRows::taken() {
    if (spoiled_ || image_.rgb.empty() || image_.rgb.size() != 3 * image_.size.pixels()) return std::nullopt;
    return std::exchange(image_, {});
}

}  // namespace ptb
