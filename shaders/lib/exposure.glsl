// SPDX-License-Identifier: Apache-2.0
// The histogram of auto exposure: 64 bins of the logarithm of luminance, 3/8 of a stop wide.
// fp32 only: 16 bits cannot count the pixels of an image.

const float kFirstStop = -12.0f;      // of the first bin: darker pixels count in it
const float kBinsOfAStop = 8.0f / 3.0f;
const float kBins = 64.0f;

// Stops -> position among the bins, [0, 64).
float binOfStops(float stops) { return clamp((stops - kFirstStop) * kBinsOfAStop, 0.0f, kBins - 0.0009765625f); }

// The stops in the middle of a bin.
float stopsOfBin(float bin) { return (bin + 0.5f) * (1.0f / kBinsOfAStop) + kFirstStop; }

// How much of a bin lies between two numbers of pixels, if `before` are in darker bins.
float countBetween(float before, float count, float low, float high) {
    return max(min(before + count, high) - max(before, low), 0.0f);
}
