#include "bench/together/hand_out.h"

#include <future>
#include <set>

#include <gtest/gtest.h>

namespace ptb {
namespace {

/// The device makes all of what it is given next; false where there is nothing.
bool make_next(HandOut& hand_out, std::size_t device, double parts_per_s) {
    const auto given = hand_out.next(device);
    if (given) hand_out.made(device, given->end, static_cast<double>(given->count()) / parts_per_s);
    return given.has_value();
}

std::vector<PartRange> all_of(const HandOut& hand_out, std::size_t devices) {
    std::vector<PartRange> all;
    for (std::size_t i = 0; i < devices; ++i)
        for (const PartRange& range : hand_out.delivered_by(i)) all.push_back(range);
    return joined(all);
}

TEST(HandOut, gives_every_part_once_and_more_to_whom_is_faster) {
    HandOut hand_out({{0, 1'000'000}}, 1000, {100'000, 100'000});
    double busy_s[] = {0, 0};
    const double parts_per_s[] = {100'000, 300'000};
    for (bool going = true; going;) {
        const std::size_t device = busy_s[0] <= busy_s[1] ? 0 : 1;
        const auto before = hand_out.made_so_far();
        going = make_next(hand_out, device, parts_per_s[device]);
        busy_s[device] += static_cast<double>(hand_out.made_so_far() - before) / parts_per_s[device];
    }
    hand_out.delivered(0);
    hand_out.delivered(1);
    EXPECT_EQ(all_of(hand_out, 2), (std::vector<PartRange>{{0, 1'000'000}}));
    EXPECT_NEAR(busy_s[0], busy_s[1], 0.05) << "they end together";
    EXPECT_NEAR(busy_s[0], 2.5, 0.05);
}

TEST(HandOut, pieces_grow_from_twenty_milliseconds_and_end_with_rounds) {
    HandOut hand_out({{0, 10'000'000}}, 5000, {1'000'000});
    EXPECT_EQ(hand_out.next(0), (PartRange{0, 20'000}));
    hand_out.made(0, 20'000, 0.02);
    EXPECT_EQ(hand_out.next(0), (PartRange{20'000, 180'000})) << "eight times as many";
    hand_out.made(0, 180'000, 0.16);
    EXPECT_EQ(hand_out.next(0)->end % 5000, 0u);
}

TEST(HandOut, gives_half_of_what_is_left_to_one_who_is_alone) {
    HandOut hand_out({{0, 100}}, 1'000'000, {1000});
    EXPECT_EQ(hand_out.next(0), (PartRange{0, 20})) << "20 ms of work";
    hand_out.made(0, 20, 0.02);
    EXPECT_EQ(hand_out.next(0), (PartRange{20, 60}));
}

TEST(HandOut, what_was_not_delivered_is_lost_with_its_device_and_given_again) {
    HandOut hand_out({{0, 1000}}, 10, {100, 100});
    ASSERT_TRUE(make_next(hand_out, 0, 100));
    hand_out.delivered(0);
    const std::vector<PartRange> kept = hand_out.delivered_by(0);
    while (make_next(hand_out, 0, 100)) {
    }
    EXPECT_EQ(hand_out.made_so_far(), 1000u);
    hand_out.lost(0);
    EXPECT_EQ(hand_out.made_so_far(), kept.at(0).count());
    while (make_next(hand_out, 1, 100)) {
    }
    hand_out.delivered(1);
    EXPECT_EQ(hand_out.delivered_by(0), kept);
    EXPECT_EQ(all_of(hand_out, 2), (std::vector<PartRange>{{0, 1000}}));
}

TEST(HandOut, whoever_is_done_waits_for_those_that_may_lose_theirs) {
    HandOut hand_out({{0, 10}}, 10, {1000, 1000});
    ASSERT_EQ(hand_out.next(0), (PartRange{0, 10}));
    EXPECT_EQ(hand_out.next(1), std::nullopt);
    auto more = std::async(std::launch::async, [&] { return hand_out.wait_for_more(1); });
    hand_out.lost(0);
    EXPECT_TRUE(more.get());
    ASSERT_EQ(hand_out.next(1), (PartRange{0, 10}));
    hand_out.made(1, 10, 1);
    EXPECT_TRUE(hand_out.has_to_deliver(1));
    hand_out.delivered(1);
    EXPECT_FALSE(hand_out.has_to_deliver(1));
    EXPECT_FALSE(hand_out.wait_for_more(0)) << "all is there";
}

TEST(HandOut, a_piece_that_was_cut_short_is_open_again) {
    HandOut hand_out({{0, 100}}, 100, {1'000'000});
    ASSERT_EQ(hand_out.next(0), (PartRange{0, 100}));
    hand_out.made(0, 40, 1);
    hand_out.stop();
    EXPECT_EQ(hand_out.next(0), std::nullopt);
    hand_out.delivered(0);
    EXPECT_EQ(hand_out.delivered_by(0), (std::vector<PartRange>{{0, 40}}));
    EXPECT_FALSE(hand_out.wait_for_more(0));
}

TEST(HandOut, asks_for_more_once_all_is_handed_out) {
    std::vector<PartRange> there{{500, 510}, {900, 905}};
    HandOut hand_out({}, 1000, {1000, 1000}, [&]() -> std::optional<PartRange> {
        if (there.empty()) return std::nullopt;
        const PartRange first = there.front();
        there.erase(there.begin());
        return first;
    });
    EXPECT_EQ(hand_out.next(0), (PartRange{500, 510}));
    EXPECT_EQ(hand_out.next(1), (PartRange{900, 905}));
    EXPECT_EQ(hand_out.next(1), std::nullopt);
    hand_out.lost(0);
    EXPECT_EQ(hand_out.next(1), (PartRange{500, 510}));
}

TEST(HandOut, repeats_what_each_device_made) {
    const std::vector<PartRange> first{{0, 10}, {30, 40}}, second{{10, 30}};
    HandOut hand_out({first, second});
    std::multiset<PartRange> given;
    for (auto range = hand_out.next(0); range; range = hand_out.next(0)) {
        given.insert(*range);
        hand_out.made(0, range->end, 1);
    }
    EXPECT_EQ(given, (std::multiset<PartRange>{{0, 10}, {30, 40}}));
    hand_out.lost(0);
    EXPECT_TRUE(hand_out.wait_for_more(0)) << "nobody else may make it";
    ASSERT_TRUE(make_next(hand_out, 1, 1));
    EXPECT_FALSE(make_next(hand_out, 1, 1));
}

}  // namespace
}  // namespace ptb
