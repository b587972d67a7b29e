// SPDX-License-Identifier: Apache-2.0
/// PublicCall: a public function of the engine, from its first line to its last. Messages about what the app gives name
/// it (base/ApiCall.h).
///   Fails   ends the process if the object was moved from, if its engine is gone, or on another thread than the
///           engine's.
///   Thread  any; that is what it is for.
///   Cost    a few loads and two words written: setTransform() of 10 000 nodes has it, too.
#pragma once

#include "base/ApiCall.h"

#include <filament_core/Engine.h>

#include <concepts>
#include <memory>
#include <string_view>

namespace filament_core::engine {

/// An address that no other thread has at the same time.
inline const void* thisThread() {
    static thread_local char here;
    return &here;
}

/// A reference to an engine from an object that may outlive it.
class EngineLink {
public:
    explicit EngineLink(Engine& engine) : mEngine(engine.share()) {}
    explicit EngineLink(Engine::Impl& engine) : EngineLink(Engine::of(engine)) {}
    bool isAlive() const { return !mEngine.expired(); }

private:
    std::weak_ptr<Engine::Impl> mEngine;
};

/// Ends the process if an object of another engine is passed. `what`: "scene".
void requireSame(Engine::Impl const& engine, Engine::Impl const& other, std::string_view what);

class PublicCall {
public:
    /// Of an engine; null: it was moved from.
    PublicCall(std::shared_ptr<Engine::Impl> const& engine, const char* function, std::string_view object = {});

    /// Of a function that is given an engine.
    PublicCall(Engine& engine, const char* function, std::string_view object = {})
            : PublicCall(engine.share().lock(), function, object) {}

    /// Of something that belongs to an engine; null: it was moved from. It has `engine`, a reference, and `link`.
    template <class Pointer>
    requires(!std::same_as<Pointer, std::shared_ptr<Engine::Impl>>) && // incomplete here: g++ 16 warns
            requires(Pointer const& part) {
        part->link.isAlive();
    }
    PublicCall(Pointer const& part, const char* function, std::string_view object = {}) : mCall(function, object) {
        if (!part) movedFrom();
        if (!part->link.isAlive()) outlived();
        checkThread(part->engine);
    }

private:
    [[noreturn]] static void movedFrom();
    [[noreturn]] static void outlived();
    static void checkThread(Engine::Impl const& engine);

    ApiCall mCall;
};

} // namespace filament_core::engine
