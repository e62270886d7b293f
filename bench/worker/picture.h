#pragma once

#include <functional>
#include <optional>
#include <string>

#include "core/image/image.h"

namespace ptb {

/// Sends an image as whole rows from the top: the first row's number, and the rows' floats in base64, in
/// pieces that fit well into a line of the protocol.
void send_rows(const Image& image, const std::function<void(int first_row, const std::string& rgb)>& send);

/// Puts an image together from its rows.
class PictureInRows {
  public:
    explicit PictureInRows(Size size) { image_.size = size; }

    /// Rows that do not follow those before, are not whole or too many spoil the picture.
    void add(int first_row, const std::string& rgb);

    /// The picture, if all of it came. To be asked once.
    std::optional<Image> taken();

  private:
    Image image_;
    bool spoiled_ = false;
};

}  // namespace ptb
