// SPDX-License-Identifier: Apache-2.0
#include "tests/faults/FailingAllocator.h"

#include "base/Assert.h"

#include <cxxabi.h>
#include <dlfcn.h>
#include <execinfo.h>
#include <link.h>
#include <malloc.h>
#include <pthread.h>

#include <array>
#include <atomic>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>
#include <string_view>

extern "C" const char __executable_start, etext; // set by the linker

namespace filament_core::test {
namespace {

constexpr int kFrames = 48;

std::atomic<bool> gArmed{ false };
std::atomic<int64_t> gUntilFailure{ 0 };
std::atomic<bool> gHasStruck{ false };
std::atomic<int64_t> gLive{ 0 }, gBytes{ 0 };
std::atomic<Whose> gWhose{ Whose::App };
std::atomic<Lasting> gLasting{ Lasting::Once };
std::atomic<Callers> gCallers{ Callers::All };
std::array<void*, kFrames> gStack{}; // of the first failure; written by the thread that set gHasStruck
int gStackDepth = 0;

constinit thread_local bool tIsApp = false;
constinit thread_local bool tIsInside = false; // backtrace() may allocate

bool isDriverThread() {
    char name[16] = {};
    pthread_getname_np(pthread_self(), name, sizeof(name));
    return std::strcmp(name, "driver") == 0;
}

bool isMeant() {
    switch (gWhose.load(std::memory_order_relaxed)) {
    case Whose::App:
        return tIsApp;
    case Whose::Driver:
        return !tIsApp && isDriverThread();
    case Whose::Jobs:
        return tAssertContext != nullptr; // the name of the job
    }
    return false;
}

bool isOfThisProgram(const void* caller) {
    return caller >= static_cast<const void*>(&__executable_start) && caller < static_cast<const void*>(&etext);
}

// A device's library calls templates of the standard library that are part of this program, so the whole stack counts.
bool isCalledByThisProgramOnly(const void* caller) {
    if (!isOfThisProgram(caller)) return false; // the common case, and fast
    tIsInside = true;
    std::array<void*, kFrames> stack{};
    const int depth = backtrace(stack.data(), kFrames);
    bool isOurs = true;
    for (int i = 0; i < depth && isOurs; ++i) {
        void* const frame = stack[static_cast<size_t>(i)];
        dl_find_object place{}; // dladdr() would also search the symbols, of which LLVM has 100 000
        if (isOfThisProgram(frame) || _dl_find_object(frame, &place) != 0) continue;
        const std::string_view library(place.dlfo_link_map->l_name);
        isOurs = library.find("libstdc++") != library.npos || library.find("libc.so") != library.npos;
    }
    tIsInside = false;
    return isOurs;
}

bool failsNow(const void* caller) {
    if (!gArmed.load(std::memory_order_acquire) || tIsInside || !isMeant()) return false;
    if (gCallers == Callers::ThisProgram && !isCalledByThisProgramOnly(caller)) return false;
    const int64_t left = gUntilFailure.fetch_sub(1, std::memory_order_relaxed) - 1;
    if (left > 0 || (left < 0 && gLasting == Lasting::Once)) return false;
    if (left == 0) {
        tIsInside = true;
        gStackDepth = backtrace(gStack.data(), kFrames);
        tIsInside = false;
        gHasStruck.store(true, std::memory_order_release);
    }
    return true;
}

void* counted(void* memory) {
    if (!memory) throw std::bad_alloc();
    gLive.fetch_add(1, std::memory_order_relaxed);
    gBytes.fetch_add(static_cast<int64_t>(malloc_usable_size(memory)), std::memory_order_relaxed);
    return memory;
}

void release(void* memory) {
    if (memory) {
        gLive.fetch_sub(1, std::memory_order_relaxed);
        gBytes.fetch_sub(static_cast<int64_t>(malloc_usable_size(memory)), std::memory_order_relaxed);
    }
    std::free(memory);
}

// "program(_ZN8filament4Foo3barEv+0x1f) [0x55...]" -> "filament_core::Foo::bar()"; empty for other functions.
std::string engineFunction(const char* line) {
    const char* begin = std::strchr(line, '(');
    const char* end = begin ? std::strpbrk(begin, "+)") : nullptr;
    if (!end) return {};
    const std::string mangled(begin + 1, end);
    int status = 0;
    const std::unique_ptr<char, decltype(&std::free)> name(
            abi::__cxa_demangle(mangled.c_str(), nullptr, nullptr, &status), &std::free);
    std::string text = status == 0 ? name.get() : "";
    if (text.find("filament_core::test") != std::string::npos) return {};
    // Templates of the standard library are identified by the engine's function that instantiates them.
    if (!text.starts_with("filament_core::")) return {};
    return text.substr(0, text.find('('));
}

} // namespace

const char* toString(Whose whose) {
    switch (whose) {
    case Whose::App:
        return "app thread";
    case Whose::Driver:
        return "driver thread";
    case Whose::Jobs:
        return "jobs";
    }
    return "?";
}

AllocationFailure::AllocationFailure(Whose whose, uint64_t at, Lasting lasting, Callers callers) {
    backtrace(gStack.data(), 1); // loads its library now, not inside operator new
    tIsApp = true;
    gWhose = whose;
    gLasting = lasting;
    gCallers = callers;
    gUntilFailure.store(static_cast<int64_t>(at), std::memory_order_relaxed);
    gHasStruck.store(false, std::memory_order_relaxed);
    gStackDepth = 0;
    gArmed.store(true, std::memory_order_release);
}

AllocationFailure::~AllocationFailure() {
    stop();
    tIsApp = false;
}

bool AllocationFailure::stop() {
    gArmed.store(false, std::memory_order_release);
    return gHasStruck.load(std::memory_order_acquire);
}

std::string AllocationFailure::lastSite() {
    const std::unique_ptr<char*, decltype(&std::free)> lines(backtrace_symbols(gStack.data(), gStackDepth), &std::free);
    std::string text;
    int functions = 0;
    for (int i = 0; i < gStackDepth && functions < 3; ++i) {
        const std::string function = engineFunction(lines.get()[i]);
        if (function.empty()) continue;
        text += (functions++ > 0 ? " < " : "") + function;
    }
    return text.empty() ? "?" : text;
}

int64_t liveBlocks() { return gLive.load(std::memory_order_relaxed); }
int64_t liveBytes() { return gBytes.load(std::memory_order_relaxed); }

} // namespace filament_core::test

// The array and nothrow forms call these.
void* operator new(size_t bytes) {
    if (filament_core::test::failsNow(__builtin_return_address(0))) throw std::bad_alloc();
    return filament_core::test::counted(std::malloc(bytes));
}
void* operator new(size_t bytes, std::align_val_t alignment) {
    if (filament_core::test::failsNow(__builtin_return_address(0))) throw std::bad_alloc();
    const auto align = static_cast<size_t>(alignment);
    return filament_core::test::counted(std::aligned_alloc(align, (bytes + align - 1) / align * align));
}
void operator delete(void* memory) noexcept { filament_core::test::release(memory); }
void operator delete(void* memory, size_t) noexcept { filament_core::test::release(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { filament_core::test::release(memory); }
void operator delete(void* memory, size_t, std::align_val_t) noexcept { filament_core::test::release(memory); }
