// SPDX-License-Identifier: Apache-2.0
/// Workload: what to measure, the contenders, and the targets. measureRounds() measures all contenders in turns, A B C
/// A B C ..., so that a machine that slows down for a while affects all of them.
///   Out     Series: one figure per round and contender; Verdicts of the targets.
///   Thread  main thread.
///   Limits  only figures of the same round are comparable: ratios are formed within a round (Statistics.h), never
///           between runs.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace filament_core::bench {

struct Settings {
    int rounds = 31;
    unsigned threads = 2;  ///< that work, including the caller
    double sampleNs = 2e6; ///< a sample repeats its work until it takes this long
    bool quick = false;    ///< small sizes: shows that it works, measures nothing
    unsigned workers() const { return threads - 1; }
};

/// Appends the figures of one round: one, or several equivalent ones (latencies).
using Sampler = std::function<void(std::vector<double>& figures)>;

struct Contender {
    std::string name; ///< its column
    Sampler sample;
    std::string note = ""; ///< "64 of 1024 jobs, scaled"
};

/// A contender without figures.
struct LeftOut {
    std::string name; ///< its column
    std::string why;
};

enum class Figure : uint8_t { Median, P99, Ratio };

/// A limit for the figure of one contender, or with Ratio for its ratio to `other` in the same round.
struct Target {
    std::string contender = "ours";
    Figure figure = Figure::Median;
    std::string other = "";
    double limit = 0;
    bool atLeast = false; ///< otherwise it is an upper limit
};

struct Workload {
    std::string name;  ///< for --filter and JSON: "batch_1k"
    std::string title; ///< for people
    std::string unit;  ///< of the figures: "ns/job"
    std::string kind;  ///< which plot: "jobs", "wakeup", "scaling", "frames", "commands"
    double x = 0;      ///< workers ("scaling") or renderables ("frames")
    std::vector<Contender> contenders;
    std::vector<Target> targets;
    std::vector<LeftOut> leftOut = {};
};

struct Series {
    std::string name, note;
    std::vector<double> rounds; ///< median of each round's figures
    std::vector<double> all;    ///< every figure
};

struct Verdict {
    Target target;
    double value = 0;
    bool isMet = false;
};

struct Measured {
    std::string name, title, unit, kind;
    double x = 0;
    std::vector<Series> series;
    std::vector<Verdict> verdicts;
    std::vector<LeftOut> leftOut = {};

    Series const* find(std::string const& contender) const;
    /// Median over the rounds of a / b; nothing if either was not measured.
    std::optional<double> ratio(std::string const& a, std::string const& b) const;
};

/// "ours <= 75 ns/job", "ours / tbb <= 0.75", "ours p99 <= 200 us"
std::string describe(Target const& target, std::string const& unit);

class Rounds {
public:
    explicit Rounds(Workload workload);
    /// Each contender once, in order. Returns the figure of "ours", or of the first one.
    double runOne();
    Measured finish() &&;

private:
    Workload mWorkload;
    std::vector<Series> mSeries;
};

} // namespace filament_core::bench
