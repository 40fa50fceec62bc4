// SPDX-License-Identifier: Apache-2.0
// Included first: replacements for the thread and system functions that Verilator's run-time library uses.
// WebAssembly has neither. Only one thread runs, so a lock does nothing.
#pragma once

#include <chrono>
#include <condition_variable>
#include <ctime>
#include <fstream>
#include <mutex>
#include <sstream>
#include <thread>

#ifndef CLOCK_PROCESS_CPUTIME_ID
#define CLOCK_PROCESS_CPUTIME_ID CLOCK_MONOTONIC
#endif

#ifdef _LIBCPP_HAS_NO_THREADS
#define OPENPPMC_NO_THREADS
#endif
#if defined(_LIBCPP_HAS_THREADS) && !_LIBCPP_HAS_THREADS
#define OPENPPMC_NO_THREADS
#endif

#ifdef OPENPPMC_NO_THREADS
namespace std {
struct mutex {
    void lock() {}
    void unlock() {}
    bool try_lock() { return true; }
};
struct recursive_mutex : mutex {};
struct condition_variable {
    void notify_one() {}
    void notify_all() {}
    template <class Lock>
    void wait(Lock&) {}
    template <class Lock, class Predicate>
    void wait(Lock&, Predicate) {}
};
struct condition_variable_any : condition_variable {};
struct thread {
    struct id {
        bool operator==(const id&) const { return true; }
        bool operator!=(const id&) const { return false; }
        bool operator<(const id&) const { return false; }
    };
    thread() {}
    template <class... Arguments>
    explicit thread(Arguments&&...) {}
    void join() {}
    bool joinable() { return false; }
    static unsigned hardware_concurrency() { return 1; }
};
namespace this_thread {
inline thread::id get_id() { return {}; }
inline void yield() {}
}  // namespace this_thread
}  // namespace std
#endif
