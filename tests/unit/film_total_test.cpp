#include "bench/together/film_total.h"

#include <span>
#include <stdexcept>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "core/render/render.h"

namespace ptb {
namespace {

constexpr FilmFacts facts{{7, 31}, {3, 6}, true, 5};

std::vector<FilmPixel> film(ptb_long radiance) {
    std::vector<FilmPixel> pixels(facts.size.pixels());
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        pixels[i].radiance[0] = radiance * static_cast<ptb_long>(i);
        pixels[i].samples = 1;
    }
    return pixels;
}

TEST(FilmTotal, is_the_sum_of_films_that_come_at_once) {
    FilmTotal total(facts.size);
    {
        std::vector<std::jthread> threads;
        for (std::size_t who = 0; who < 12; ++who)
            threads.emplace_back([&total, who] { total.add(facts, film(static_cast<ptb_long>(who)), who); });
    }
    FilmSums alone{facts, film(0)};
    for (ptb_long who = 1; who < 12; ++who) add_sums(alone, {facts, film(who)});
    const auto sums = total.take();
    ASSERT_TRUE(sums);
    EXPECT_EQ(sums->facts, alone.facts);
    EXPECT_EQ(film_of(*sums).hash, film_of(alone).hash);
}

TEST(FilmTotal, has_nothing_where_no_film_came_and_takes_none_of_another_image) {
    FilmTotal total(facts.size);
    EXPECT_FALSE(total.take());
    total.add(facts, film(1), 0);
    FilmFacts scaled = facts;
    scaled.scale.radiance = 4;
    EXPECT_THROW(total.add(scaled, film(1), 1), std::invalid_argument);
    const std::vector<FilmPixel> whole = film(1);
    EXPECT_THROW(total.add(facts, std::span(whole).first(7), 1), std::invalid_argument);
}

}  // namespace
}  // namespace ptb
