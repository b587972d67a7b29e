// SPDX-License-Identifier: Apache-2.0
#include "backend/layers/Validated.h"

#include "backend/layers/Validator.h"

#include <utility>

namespace filament_core::backend {
namespace {

class Validated final : public Driver {
public:
    Validated(std::unique_ptr<Driver> inner, ResultSink& sink)
            : mInner(std::move(inner)), mValidator(mInner->info(), sink) {}

    DeviceInfo const& info() const override { return mInner->info(); }
    void execute(CommandView commands) override {
        if (mValidator.check(commands)) mInner->execute(commands);
    }
    void waitIdle() override { mInner->waitIdle(); }
    DriverStatistics statistics() const override { return mInner->statistics(); }

private:
    std::unique_ptr<Driver> mInner;
    Validator mValidator;
};

} // namespace

std::unique_ptr<Driver> validate(std::unique_ptr<Driver> inner, ResultSink& sink) {
    return std::make_unique<Validated>(std::move(inner), sink);
}

} // namespace filament_core::backend
