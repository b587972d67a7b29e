// SPDX-License-Identifier: Apache-2.0
/// Background: a function on a thread of its own, whose result is asked for once a frame.
///   Thread  all calls belong to one thread; the function runs on another one.
///   Wait    take() before isFinished(), and the end of the last owner. Code that must not wait keeps it in Abandoned.
#pragma once

#include <algorithm>
#include <chrono>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <vector>

namespace filament_core::view {

template <class T>
class Background {
public:
    explicit Background(std::function<T()> work)
            : mFuture(std::make_shared<std::future<T>>(std::async(std::launch::async, std::move(work)))) {}

    bool isFinished() const { return mFuture->wait_for(std::chrono::seconds(0)) == std::future_status::ready; }
    T take() { return mFuture->get(); }
    void wait() const { mFuture->wait(); }
    /// True once it is finished; keeps it until then.
    std::function<bool()> rest() const {
        return [future = mFuture] { return future->wait_for(std::chrono::seconds(0)) == std::future_status::ready; };
    }

private:
    std::shared_ptr<std::future<T>> mFuture;
};

/// What it gave, once it is finished; `work` is empty then.
template <class T>
std::optional<T> takeFinished(std::optional<Background<T>>& work) {
    if (!work || !work->isFinished()) return std::nullopt;
    std::optional<T> result(work->take());
    work.reset();
    return result;
}

/// Abandoned functions, until they are finished. Its own end waits for them.
class Abandoned {
public:
    template <class T>
    void add(Background<T> const& work) {
        mRest.push_back(work.rest());
    }
    /// If there is one; `work` is empty then.
    template <class T>
    void add(std::optional<Background<T>>& work) {
        if (work) add(*work);
        work.reset();
    }
    void removeFinished() {
        std::erase_if(mRest, [](std::function<bool()> const& isFinished) { return isFinished(); });
    }

private:
    std::vector<std::function<bool()>> mRest;
};

} // namespace filament_core::view
