// SPDX-License-Identifier: Apache-2.0
#include "tests/jobsystem/ModelChecker.h"

#include "tests/jobsystem/ModelFiber.h"
#include "tests/jobsystem/ModelSchedule.h"
#include "tests/jobsystem/ModelSearch.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <utility>
#include <vector>

namespace filament_core::jobs::model {
namespace {

struct RunGivenUp {}; // unwinds the stack of a thread whose run is over

enum class End : uint8_t { None, AllReturned, AllSleep, Pruned, Failed };

enum class State : uint8_t { Ready, Sleeping, Returned };

struct Thread {
    std::unique_ptr<Fiber> fiber;
    State state = State::Ready;
    Operation next; // announced, but not performed
};

struct Step {
    int thread;
    Operation operation;
    uint64_t before;
    const char* note;
};

class Checker {
public:
    explicit Checker(Options const& options) : mOptions(options), mSchedule(options.seed) {}

    Report explore(std::function<std::unique_ptr<Scenario>()> const& make);

    void created(const void* object, uint64_t initial);
    void destroyed(const void* object);
    Outcome perform(const void* object, Operation operation);
    void pause();
    void yield();
    void fail(const char* rule);
    int self() const { return mSelf; }
    bool isUnwinding() const { return mEnd != End::None; }
    ModelMemory const& memory() const { return mMemory; }

private:
    void prepareThreads(int count);
    void runOnce(std::function<std::unique_ptr<Scenario>()> const& make);
    void judge(Scenario& scenario);
    void runThread(int thread);
    void leave();
    void announce(Operation const& operation);
    int nextThread();
    int branch(uint32_t ready);
    uint32_t allowedNow(uint32_t ready) const;
    uint32_t readyThreads() const;
    uint32_t threadsIn(State state) const;
    bool isRandom() const { return mOptions.schedules > 0; }
    StoreIndex pick(Choices const& choices) {
        return choices.stores[isRandom() ? mSchedule.pickStore(choices.count) : mSearch.pick(choices.count)];
    }
    uint32_t pick(uint32_t count) { return isRandom() ? mSchedule.pick(count) : mSearch.pick(count); }
    bool isFinished();
    int find(const void* object) const;
    Outcome make(Operation const& operation);
    Outcome change(Operation const& operation);
    Outcome performAlone(Operation const& operation);
    Outcome compareExchange(Operation const& operation);
    void wait(Operation const& operation);
    void notify(Operation const& operation);
    void note(const char* rule);
    std::string describeRun() const;

    Options const& mOptions;
    ModelMemory mMemory;
    Report mReport;
    Fiber mMain;
    std::vector<Thread> mThreads;
    Scenario* mScenario = nullptr;

    ModelSearch mSearch;
    ModelSchedule mSchedule;
    std::vector<const void*> mObjects; // by location
    std::vector<Step> mSteps;
    int mPreemptions = 0, mSpuriousReturns = 0;
    int mSelf = -1; // the thread that runs; negative: none
    int mLast = -1; // the thread that ran last
    End mEnd = End::None;
    std::string mFailure;
};

Checker* gChecker = nullptr;

// ---------------------------------------------------------------------------------------------- the search

Report Checker::explore(std::function<std::unique_ptr<Scenario>()> const& make) {
    do {
        runOnce(make);
        mReport.steps += mSteps.size();
        (mEnd == End::Pruned ? mReport.pruned : mReport.runs) += 1;
        if (mFailure.empty() && mReport.runs + mReport.pruned == mOptions.maxRuns) mFailure = "too many runs";
    } while (mFailure.empty() && !isFinished());
    mReport.preemptions = mOptions.preemptions;
    mReport.isRandom = isRandom();
    mReport.failure = mFailure;
    return mReport;
}

bool Checker::isFinished() { return isRandom() ? mReport.runs == mOptions.schedules : !mSearch.advance(); }

void Checker::prepareThreads(int count) {
    if (mThreads.empty()) mThreads.resize(static_cast<size_t>(count));
    for (int i = 0; i < count; ++i) {
        Thread& thread = mThreads[static_cast<size_t>(i)];
        thread.state = State::Ready;
        thread.next = {};
        if (!thread.fiber) thread.fiber = std::make_unique<Fiber>([this, i] { runThread(i); });
    }
}

void Checker::runOnce(std::function<std::unique_ptr<Scenario>()> const& make) {
    mMemory.clear();
    mObjects.clear();
    mSteps.clear();
    mSearch.beginRun();
    mPreemptions = mSpuriousReturns = 0;
    mSelf = mLast = -1;
    mEnd = End::None;

    const std::unique_ptr<Scenario> scenario = make();
    mScenario = scenario.get();
    prepareThreads(scenario->threads());
    mMemory.setThreads(scenario->threads());
    if (isRandom()) mSchedule.beginRun(mReport.runs, scenario->threads());
    for (int i = 0; i < static_cast<int>(mThreads.size()); ++i) mMemory.tick(i);
    const int first = nextThread();
    mMain.switchTo(*mThreads[static_cast<size_t>(first)].fiber);

    mSelf = -1;
    if (mEnd == End::AllReturned || mEnd == End::AllSleep) judge(*scenario);
    for (size_t i = 0; i < mThreads.size(); ++i) { // those that are still inside an operation
        mSelf = static_cast<int>(i);
        if (mThreads[i].state != State::Returned) mMain.switchTo(*mThreads[i].fiber);
    }
    mSelf = -1;
}

void Checker::judge(Scenario& scenario) {
    const End end = std::exchange(mEnd, End::None); // the scenario may look at its atomics and fail
    if (end == End::AllSleep && !scenario.mayRest()) {
        note("every thread sleeps");
    } else {
        scenario.atEnd();
    }
    if (mEnd == End::None) mEnd = end;
}

/// The body of every fiber: each iteration is one run.
void Checker::runThread(int thread) {
    for (;;) {
        mSelf = thread;
        if (mEnd == End::None) { // else this run was over before this thread began
            try {
                mScenario->run(thread);
            } catch (RunGivenUp const&) {
            }
        }
        mThreads[static_cast<size_t>(thread)].state = State::Returned;
        leave();
    }
}

/// The running thread has finished its part of this run.
void Checker::leave() {
    Fiber& here = *mThreads[static_cast<size_t>(mSelf)].fiber;
    const int next = mEnd == End::None ? nextThread() : -1;
    here.switchTo(next < 0 ? mMain : *mThreads[static_cast<size_t>(next)].fiber);
}

// ---------------------------------------------------------------------------------------------- who goes next

uint32_t Checker::threadsIn(State state) const {
    uint32_t mask = 0;
    for (size_t i = 0; i < mThreads.size(); ++i) {
        if (mThreads[i].state == state) mask |= 1u << i;
    }
    return mask;
}

uint32_t Checker::readyThreads() const {
    uint32_t mask = threadsIn(State::Ready);
    for (size_t i = 0; i < mThreads.size(); ++i) {
        const bool pauses = mThreads[i].next.kind == Kind::Pause && !mMemory.hasUnseenStores(static_cast<int>(i));
        if (pauses) mask &= ~(1u << i);
    }
    return mask;
}

uint32_t Checker::allowedNow(uint32_t ready) const {
    const bool mustStay = mOptions.preemptions >= 0 && mPreemptions >= mOptions.preemptions && mLast >= 0;
    const uint32_t last = mLast < 0 ? 0 : 1u << mLast;
    return mustStay && (ready & last) ? last : ready;
}

/// Negative if the run is over.
int Checker::nextThread() {
    const uint32_t ready = readyThreads();
    if (ready == 0) {
        const uint32_t left = threadsIn(State::Sleeping) | threadsIn(State::Ready);
        mEnd = left ? End::AllSleep : End::AllReturned;
        return -1;
    }
    if (mSteps.size() >= mOptions.maxSteps) {
        note("the run does not end");
        return -1;
    }
    // A step that touches nothing is independent of all others, so no other order need be tried.
    for (int i = 0; i < static_cast<int>(mThreads.size()); ++i) {
        Thread const& thread = mThreads[static_cast<size_t>(i)];
        if (thread.state == State::Ready && thread.next.kind == Kind::Resume) return i;
    }
    const int next = branch(ready);
    if (next < 0) return -1;
    if (mLast >= 0 && mLast != next && (ready >> mLast & 1)) ++mPreemptions;
    return mLast = next;
}

int Checker::branch(uint32_t ready) {
    if (isRandom()) return mSchedule.pickThread(ready);
    const int next = mSearch.pickThread(allowedNow(ready), mLast);
    if (next < 0) {
        mEnd = End::Pruned;
        return next;
    }
    if (mOptions.preemptions >= 0) return next; // a bound omits runs that the sleep sets would rely on
    uint32_t asleep = 0;
    for (size_t i = 0; i < mThreads.size(); ++i) {
        if (!(mSearch.explored() >> i & 1)) continue;
        Operation const& made = mThreads[static_cast<size_t>(next)].next;
        const bool settled = made.location >= 0 && mMemory.isSettled(made.location);
        if (areIndependent(mThreads[i].next, made, settled)) asleep |= 1u << i;
    }
    mSearch.setSleepSet(asleep);
    return next;
}

/// Returns when it is this thread's turn to perform the operation.
void Checker::announce(Operation const& operation) {
    const int self = mSelf;
    Thread& thread = mThreads[static_cast<size_t>(self)];
    thread.next = operation;
    const int next = nextThread();
    if (next != self) thread.fiber->switchTo(next < 0 ? mMain : *mThreads[static_cast<size_t>(next)].fiber);
    if (mEnd != End::None) throw RunGivenUp{};
    mSelf = self;
}

// ---------------------------------------------------------------------------------------------- operations

void Checker::created(const void* object, uint64_t initial) {
    if (mMemory.create(mSelf, initial) < 0) {
        note("the scenario has too many atomics");
        return;
    }
    mObjects.push_back(object);
}

void Checker::destroyed(const void* object) {
    const int location = find(object);
    if (location < 0 || isUnwinding()) return;
    if (!mMemory.destroy(mSelf, location)) note("an atomic is destroyed while another thread may still use it");
}

int Checker::find(const void* object) const { // the newest one, because memory is reused
    for (int i = static_cast<int>(mObjects.size()) - 1; i >= 0; --i) {
        if (mObjects[static_cast<size_t>(i)] == object) return i;
    }
    return -1;
}

Outcome Checker::perform(const void* object, Operation operation) {
    operation.location = find(object);
    if (isUnwinding()) { // destructors of objects that the run left behind
        if (mSelf >= 0 && std::uncaught_exceptions() == 0) throw RunGivenUp{};
        return {};
    }
    if (mSelf < 0) return performAlone(operation);
    if (mOptions.mutate) mOptions.mutate(operation);
    announce(operation);
    if (!mMemory.isAlive(operation.location)) fail("an atomic is used after its destruction");
    if (!mMemory.isConstructedFor(mSelf, operation.location)) fail("an atomic is used before its construction");
    mMemory.tick(mSelf);
    mSteps.push_back({ mSelf, operation, 0, "" });
    const Outcome outcome = make(operation);
    mMemory.tick(mSelf); // later steps of the thread are not covered by the operation's release
    return outcome;
}

void Checker::pause() {
    announce({ .kind = Kind::Pause, .function = "pause" });
    mSteps.push_back({ mSelf, { .kind = Kind::Pause, .function = "pause" }, 0, "" });
    mMemory.seeEverything(mSelf);
}

void Checker::yield() {
    if (isRandom()) mSchedule.yield(mSelf);
    announce({ .kind = Kind::Yield, .function = "yield" });
    mSteps.push_back({ mSelf, { .kind = Kind::Yield, .function = "yield" }, 0, "" });
}

Outcome Checker::make(Operation const& operation) {
    const int at = operation.location;
    const uint64_t operand = operation.operand;
    switch (operation.kind) {
    case Kind::Load: {
        const StoreIndex from = pick(mMemory.readable(mSelf, at, operation.order));
        const uint64_t value = mMemory.load(mSelf, at, from, operation.order);
        mSteps.back().before = value;
        return { value };
    }
    case Kind::Store: {
        const StoreIndex after = pick(mMemory.followable(mSelf, at, operation.order));
        if (!mMemory.store(mSelf, at, after, operand, operation.order)) fail("the scenario stores too often");
        return {};
    }
    case Kind::Exchange:
    case Kind::Add:
    case Kind::And:
    case Kind::Or:
        return change(operation);
    case Kind::CompareExchange:
        return compareExchange(operation);
    case Kind::Wait:
        wait(operation);
        return {};
    case Kind::NotifyOne:
    case Kind::NotifyAll:
        notify(operation);
        return {};
    case Kind::Assume:
    case Kind::Pause:
    case Kind::Yield:
    case Kind::Resume:
        return {};
    }
    return {};
}

Outcome Checker::change(Operation const& operation) {
    const int at = operation.location;
    const StoreIndex from = pick(mMemory.followable(mSelf, at, operation.order));
    const uint64_t before = mMemory.value(at, from);
    mSteps.back().before = before;
    if (!mMemory.modify(mSelf, at, from, operation.result(before), operation.order))
        fail("the scenario stores too often");
    return { before };
}

// The scenario is being created or checked; no thread runs.
Outcome Checker::performAlone(Operation const& operation) {
    const uint64_t before = mMemory.latest(operation.location);
    const bool fits = operation.kind != Kind::CompareExchange || before == operation.expected;
    if (operation.kind != Kind::Load && fits) mMemory.replaceLatest(operation.location, operation.result(before));
    return { before, fits };
}

Outcome Checker::compareExchange(Operation const& operation) {
    const int at = operation.location;
    Choices choices;
    const Choices equal = mMemory.followable(mSelf, at, operation.order);
    for (uint32_t i = 0; i < equal.count; ++i) {
        const StoreIndex store = equal.stores[i];
        if (mMemory.value(at, store) == operation.expected) choices.stores[choices.count++] = store;
    }
    const Choices different = mMemory.readable(mSelf, at, operation.failureOrder);
    for (uint32_t i = 0; i < different.count; ++i) {
        const StoreIndex store = different.stores[i];
        if (mMemory.value(at, store) != operation.expected) choices.stores[choices.count++] = store;
    }
    const StoreIndex from = pick(choices);
    const uint64_t before = mMemory.value(at, from);
    mSteps.back().before = before;
    if (before == operation.expected) {
        mSteps.back().note = " (succeeds)";
        if (!mMemory.modify(mSelf, at, from, operation.operand, operation.order)) fail("the scenario stores too often");
        return { before, true };
    }
    mMemory.load(mSelf, at, from, operation.failureOrder);
    return { before, false };
}

void Checker::wait(Operation const& operation) {
    const int at = operation.location;
    const StoreIndex from = pick(mMemory.readableByKernel(mSelf, at));
    const uint64_t value = mMemory.load(mSelf, at, from, std::memory_order_relaxed);
    mMemory.notePassedThroughKernel(mSelf, at);
    mSteps.back().before = value;
    if (value != operation.expected) return;
    if (mSpuriousReturns < mOptions.spuriousReturns && pick(2u) == 1) {
        ++mSpuriousReturns;
        mSteps.back().note = " (returns for no reason)";
        return;
    }
    mSteps.back().note = " (sleeps)";
    Thread& thread = mThreads[static_cast<size_t>(mSelf)];
    thread.state = State::Sleeping;
    Operation resume;
    resume.location = at; // until it is woken: what it sleeps on
    announce(resume);
}

void Checker::notify(Operation const& operation) {
    mMemory.notePassedThroughKernel(mSelf, operation.location);
    std::vector<Thread*> sleepers;
    for (Thread& thread : mThreads) {
        if (thread.state == State::Sleeping && thread.next.location == operation.location) sleepers.push_back(&thread);
    }
    if (sleepers.empty()) return;
    if (operation.kind == Kind::NotifyOne) sleepers = { sleepers[pick(static_cast<uint32_t>(sleepers.size()))] };
    mSteps.back().before = sleepers.size();
    for (Thread* thread : sleepers) {
        thread->state = State::Ready;
        thread->next.location = -1;
    }
}

// ---------------------------------------------------------------------------------------------- failures

void Checker::note(const char* rule) {
    if (mEnd != End::None) return;
    mEnd = End::Failed;
    mFailure = std::string(rule) + '\n' + describeRun();
}

void Checker::fail(const char* rule) {
    note(rule);
    if (mSelf >= 0 && std::uncaught_exceptions() == 0) throw RunGivenUp{};
}

std::string Checker::describeRun() const {
    std::string text;
    for (Step const& step : mSteps) {
        Operation const& made = step.operation;
        text += "  thread " + std::to_string(step.thread) + ": atomic " + std::to_string(made.location) + ' ' +
                nameOf(made.kind) + ' ' + nameOf(made.order) + " finds " + std::to_string(step.before);
        if (made.kind != Kind::Load) text += ", operand " + std::to_string(made.operand);
        text += std::string(step.note) + " in " + std::string(made.function) + "(), line " + std::to_string(made.line) +
                '\n';
    }
    return text;
}

} // namespace

// ---------------------------------------------------------------------------------------------- doors

Report explore(std::function<std::unique_ptr<Scenario>()> const& make, Options const& options) {
    const auto checker = std::make_unique<Checker>(options);
    Checker* outer = std::exchange(gChecker, checker.get());
    const Report report = checker->explore(make);
    gChecker = outer;
    return report;
}

void require(bool condition, const char* rule) {
    if (!condition) gChecker->fail(rule);
}

void printExplored(std::string const& what, Report const& report) {
    const std::string bound = report.isRandom ? " (random schedules)"
                              : report.preemptions < 0
                                      ? ""
                                      : " (at most " + std::to_string(report.preemptions) + " preemptions)";
    std::printf("[ EXPLORED ] %s%s: %llu runs, %llu more given up as equal, %llu steps\n", what.c_str(), bound.c_str(),
                static_cast<unsigned long long>(report.runs), static_cast<unsigned long long>(report.pruned),
                static_cast<unsigned long long>(report.steps));
    std::fflush(stdout);
}

Options boundedIfSanitized(Options options) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    options.preemptions = options.preemptions < 0 ? 2 : std::min(options.preemptions, 2);
#endif
    return options;
}

uint64_t stressFactor() {
    const char* text = std::getenv("FILAMENT_STRESS");
    return text ? std::strtoull(text, nullptr, 10) : 0;
}

void pause() { gChecker->pause(); }
void yield() { gChecker->yield(); }

void created(const void* object, uint64_t initial) { gChecker->created(object, initial); }
void destroyed(const void* object) { gChecker->destroyed(object); }
Outcome perform(const void* object, Operation operation) { return gChecker->perform(object, operation); }

void RaceDetector::read() {
    const int self = gChecker->self();
    if (self < 0 || gChecker->isUnwinding()) return;
    for (int i = 0; i < kMaxThreads; ++i) {
        if (i != self && !gChecker->memory().happenedBefore(self, mWrittenAt[i], i))
            gChecker->fail("a data race: a read that a write does not happen before");
    }
    mReadAt[self] = gChecker->memory().view(self).clock[self];
}

void RaceDetector::write() {
    read();
    const int self = gChecker->self();
    if (self < 0 || gChecker->isUnwinding()) return;
    for (int i = 0; i < kMaxThreads; ++i) {
        if (i != self && !gChecker->memory().happenedBefore(self, mReadAt[i], i))
            gChecker->fail("a data race: a write that a read does not happen before");
    }
    mWrittenAt[self] = gChecker->memory().view(self).clock[self];
}

} // namespace filament_core::jobs::model
