#pragma once

#include <optional>

#include "bench/record/record.h"
#include "bench/validate/passes.h"
#include "core/oracle/reference.h"
#include "core/render/render.h"

namespace ptb {

/// Samples of the render that decides whether a kernel is right, and the size of its image.
inline constexpr std::uint64_t validation_samples = 10'000'000;
inline constexpr Size validation_size{128, 128};

/// One family of block tests rejects a right image with this probability.
inline constexpr double family_alpha = 0.001;
/// Blocks hold at least as many samples, and grow until nine in ten are worth as many hits of the light; only
/// means near enough to Gaussian are tested.
inline constexpr std::uint64_t block_samples = 60'000;
inline constexpr double block_hits = 100;

/// A film to be judged, and the job it came from.
struct FilmEvidence {
    const Film& film;
    Size size;
    int spp = 1;
    int path_length = 1;
    Roulette roulette = Roulette::off;
    const Passes* passes = nullptr;  ///< of the same work, at any size: where its pixels share paths
};
FilmEvidence evidence_of(const Film& film, const RenderJob& job, const Passes* passes = nullptr);

/// Checks what needs no reference: every value finite and not negative, no sample lost or made up, between
/// one and path_length segments a sample.
Validation check_film(const FilmEvidence& evidence);

/// Adds the tests against a reference of the same scene, kernel and path length, same or different size:
/// pixel blocks and the independence of neighbouring pixels (same size only), image mean within 4 combined
/// standard errors, segments per sample and the share of full-length paths within 4. Paths that roulette ends
/// have other lengths than the reference's, and vary more: these two are left out, and the film's own
/// variance counts where it is larger. So does that of passes, whose sum the film then is; neighbours share
/// paths then, and are not compared. Of a picture that is biased only the counts are tested.
void check_against(Validation& validation, const FilmEvidence& evidence, const Reference& reference);

/// Adds the tests that any timed render of the work must pass: image mean and segments (without roulette)
/// within 5 standard errors.
void check_timed(Validation& validation, const FilmEvidence& evidence, const Reference& reference);

/// Two films of the same work must not differ in a bit; `what` says how they were made differently.
void check_same_bits(Validation& validation, const Film& film, const Film& other, const std::string& what);

/// Two-sided normal quantile at which a family of `tests` independent tests errs with probability `alpha`
/// (Sidak).
double sidak_limit(double alpha, std::size_t tests);

/// Notes a failed check; the first one is the record's reason.
void fail(Validation& validation, const std::string& reason);

}  // namespace ptb
