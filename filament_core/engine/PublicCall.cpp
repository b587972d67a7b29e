// SPDX-License-Identifier: Apache-2.0
#include "filament_core/engine/PublicCall.h"

#include "filament_core/engine/EngineImpl.h"

#include <fmt/format.h>

namespace filament_core::engine {

PublicCall::PublicCall(std::shared_ptr<Engine::Impl> const& engine, const char* function, std::string_view object)
        : mCall(function, object) {
    if (!engine) movedFrom();
    checkThread(*engine);
}

void PublicCall::movedFrom() { misused("the object was moved from; use the one that it was moved to"); }

void PublicCall::outlived() { misused("its engine is gone; destroy engines last"); }

void PublicCall::checkThread(Engine::Impl const& engine) {
    if (engine.appThread != thisThread())
        misused("called on another thread than the engine's, which is the one that created it, or that called "
                "Engine::useOnThisThread() last");
}

void requireSame(Engine::Impl const& engine, Engine::Impl const& other, std::string_view what) {
    if (&engine != &other) misused(fmt::format("the {} belongs to another engine", what));
}

} // namespace filament_core::engine
