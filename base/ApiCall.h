// SPDX-License-Identifier: Apache-2.0
/// ApiCall: the public function that the calling thread is in, for messages about how an app uses it. The outermost one
/// counts: what it calls in its turn is none of the app's doing.
///   Fails   misused() and FILAMENT_ASSERT name it, and what it was called for.
///   Thread  any; each thread has its own.
///   Cost    two words written.
#pragma once

#include <string_view>

namespace filament_core {

struct ApiCallInfo {
    const char* function = nullptr; ///< "Scene::add(RenderableDesc)"; null: none
    std::string_view object{};      ///< the name of what it is called for; may be empty
};

inline constinit thread_local ApiCallInfo tApiCall;

class ApiCall {
public:
    explicit ApiCall(const char* function, std::string_view object = {}) : mIsOutermost(!tApiCall.function) {
        if (mIsOutermost) tApiCall = { function, object };
    }
    ~ApiCall() {
        if (mIsOutermost) tApiCall = {};
    }
    ApiCall(ApiCall const&) = delete;
    ApiCall& operator=(ApiCall const&) = delete;

private:
    bool mIsOutermost;
};

/// Ends the process: the app broke a rule that `what` says, in the current ApiCall. For rules about what the app gives;
/// FILAMENT_ASSERT also says where in the engine a rule is.
[[noreturn]] void misused(std::string_view what);

} // namespace filament_core
