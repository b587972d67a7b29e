// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/image/ChannelTransfer.h"

#include "base/math/Elementary.h"

#include <filament_core/Color.h>

#include <cmath>
#include <memory>

namespace filament_core::assets {

double linearFromSrgb(double code) {
    return code <= 0.04045 ? code / 12.92 : elementary::pow((code + 0.055) / 1.055, 2.4);
}

namespace {

std::unique_ptr<ChannelTransfer> makeTransfer(double (*linearFromUnit)(double)) {
    auto transfer = std::make_unique<ChannelTransfer>();
    for (size_t code = 0; code < 256; ++code) {
        const double linear = linearFromUnit(static_cast<double>(code) / 255.0);
        transfer->linearFromCode[code] = static_cast<uint16_t>(std::lround(linear * 65535.0));
    }
    size_t code = 0;
    for (size_t linear = 0; linear < 65536; ++linear) {
        // twice the midpoint between two codes, so that it is an integer
        while (code < 255 && 2 * linear > size_t{ transfer->linearFromCode[code] } + transfer->linearFromCode[code + 1])
            ++code;
        transfer->codeFromLinear[linear] = static_cast<uint8_t>(code);
    }
    return transfer;
}

} // namespace

ChannelTransfer const& colorTransfer() {
    static const std::unique_ptr<ChannelTransfer> kTransfer = makeTransfer(linearFromSrgb);
    return *kTransfer;
}

ChannelTransfer const& dataTransfer() {
    static const std::unique_ptr<ChannelTransfer> kTransfer = makeTransfer([](double value) { return value; });
    return *kTransfer;
}

std::vector<float> const& lightOfDeepCodes() {
    static const std::vector<float> kTable = [] {
        constexpr uint32_t kDeepCodes = 65536;
        std::vector<float> light;
        light.reserve(kDeepCodes);
        for (uint32_t code = 0; code < kDeepCodes; ++code)
            light.push_back(color::linearFromSrgb(float3(shareOfDeepCode(code))).x);
        return light;
    }();
    return kTable;
}

} // namespace filament_core::assets
