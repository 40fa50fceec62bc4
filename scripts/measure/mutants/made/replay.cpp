// SPDX-License-Identifier: Apache-2.0
// Main program that replays recordings of tests into the mutants of a design:
//     Vtop RECORDINGS EVERY BUDGET MUTANT ...
// A model without a mutant replays each recording and notes the mutants that have another value than the RTL. A mutant
// is simulated only from the block of cycles in which it is noted until its registers are those of the RTL again, for
// at most BUDGET cycles in all, and less while nothing new happens. If an output differs, the mutant alone replays the
// whole recording, to be sure. For each mutant that differs, the program prints its number, and the number of the
// recording. replay.py writes the file of recordings, which consists of 64-bit words and names.
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iostream>
#include <iterator>
#include <list>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <vector>

#include "Vtop.h"
#include "Vtop___024root.h"
#include "verilated.h"
#include "verilated_syms.h"

void Vtop___024root___eval_settle(Vtop___024root* model);  // of Verilator

namespace {

using Word = std::uint64_t;

struct Row {
    Word t, port, level;
};
struct Recording {
    Word number, end;
    std::vector<Word> levels;  // of all words of all ports at the start
    std::vector<Row> inputs, outputs;
};

constexpr Word RESET = 6;       // number of steps before the first cycle of a recording
constexpr Word BLOCK = 16;      // number of steps of a block
constexpr int TRIALS = 4;       // number of blocks with a step of the same kind in which a mutant is simulated in vain
constexpr int PATIENCE = 1024;  // number of successive blocks without a new kind of step in which it may go on
constexpr std::size_t CHECKED = 20;  // number of recordings with which the layout is checked
constexpr std::size_t SIZE = offsetof(Vtop___024root, vlSymsp);  // of all variables, in bytes

std::vector<std::string> ports;  // clk, rst_n, the other inputs, the outputs
Word inputs = 0;                 // number of words of the inputs
std::vector<Recording> recordings;
std::vector<char> noted;

Word word_at(const char* place) {
    Word value;
    std::memcpy(&value, place, 8);
    return value;
}

class Reader {
  public:
    explicit Reader(const char* path)
        : file_(path, std::ios::binary), data_(std::istreambuf_iterator<char>(file_), {}) {}
    bool more() const { return at_ < data_.size(); }
    Word word() { return word_at(&data_.at((at_ += 8) - 1) - 7); }
    std::string text(Word size) { return {&data_[(at_ += size) - size], size}; }
    std::vector<Row> rows() {
        std::vector<Row> found(word());
        for (Row& row : found) row = {word(), word(), word()};
        return found;
    }

  private:
    std::ifstream file_;
    std::vector<char> data_;
    std::size_t at_ = 0;
};

void read(const char* path) {
    Reader reader(path);
    Word words = 0;
    inputs = reader.word();
    for (Word left = reader.word(); left > 0; --left) {
        const Word count = reader.word();
        ports.push_back(reader.text(reader.word()));
        words += count;
    }
    while (reader.more()) {
        Recording recording{reader.word(), reader.word(), std::vector<Word>(words), {}, {}};
        for (Word& level : recording.levels) level = reader.word();
        recording.inputs = reader.rows();
        recording.outputs = reader.rows();
        recordings.push_back(std::move(recording));
    }
}

// A place in a recording: the next step, what was not yet applied or expected, and the expected levels.
struct Cursor {
    const Recording* recording;
    Word step, quiet;
    std::vector<Row>::const_iterator input, output;
    std::vector<Word> expected;

    explicit Cursor(const Recording& from)
        : recording(&from), step(0), quiet(0), input(from.inputs.begin()), output(from.outputs.begin()),
          expected(from.levels) {}
    bool more() const { return step <= recording->end + RESET; }
};

class Model {
  public:
    // The registers have random values at power-up, others in each recording.
    Model(int mutant, const Recording& recording) : chosen_("+mutant=" + std::to_string(mutant)) {
        const char* words[] = {"replay", chosen_.c_str()};
        context_.commandArgs(2, words);
        context_.threads(1);
        context_.randReset(2);
        context_.randSeed(static_cast<int>(recording.number + 1));
        context_.assertOn(false);
        top_ = std::make_unique<Vtop>(&context_, "");
        for (const std::string& port : ports) {
            const VerilatedVar* const var = context_.scopeFind("TOP")->varFind(port.c_str());
            for (std::size_t at = 0; at < var->entSize(); at += 8)
                places_.push_back(
                    {static_cast<char*>(var->datap()) + at, std::min<std::size_t>(8, var->entSize() - at)});
        }
    }

    ~Model() { Verilated::threadContextp(&context_); }  // of the scopes

    // Simulate up to `steps` steps; return false in the first in which an output differs.
    bool run(Cursor& at, Word steps) {
        Verilated::threadContextp(&context_);  // of the arguments
        for (const Word last = at.step + steps; at.step < last && at.more(); ++at.step)
            if (!(at.step < RESET ? reset(at) : cycle(at, at.step - RESET))) return false;
        return true;
    }

    // Run the initial blocks, which also select the mutant, before a state is copied.
    void select(const Recording& recording) {
        Cursor at(recording);
        try {
            run(at, 1);
        } catch (const std::runtime_error&) {
            // The levels do not become stable, as in the next step.
        }
    }

    // Compute all signals that depend on registers only.
    void settle() { Vtop___024root___eval_settle(top_->rootp); }

    char* state() { return reinterpret_cast<char*>(top_->rootp); }

  private:
    struct Place {
        char* data;
        std::size_t bytes;
    };

    void put(Word word, Word level) { std::memcpy(places_[word].data, &level, places_[word].bytes); }

    void edge() {
        put(0, 1);
        top_->eval();
        put(0, 0);
    }

    bool reset(Cursor& at) {
        if (at.step == 0) {
            for (Word word = 2; word < inputs; ++word) put(word, at.expected[word]);
            for (; at.input != at.recording->inputs.end() && at.input->t == 0; ++at.input)
                put(at.input->port, at.input->level);
            put(0, 0);
            put(1, 1);
        } else if (at.step == 1) {
            put(1, 0);
        } else {
            edge();
        }
        top_->eval();
        if (at.step == RESET - 1) put(1, 1);
        return true;
    }

    bool cycle(Cursor& at, Word t) {
        for (; at.input != at.recording->inputs.end() && at.input->t == t; ++at.input) {
            if (at.input->port == 1) at.quiet = t + 2;  // an asynchronous reset may act one cycle earlier or later
            put(at.input->port, at.input->level);
        }
        top_->eval();
        edge();
        for (; at.output != at.recording->outputs.end() && at.output->t == t; ++at.output)
            at.expected[at.output->port] = at.output->level;
        if (t < at.quiet) return true;
        for (Word word = inputs; word < places_.size(); ++word) {
            Word level = 0;
            std::memcpy(&level, places_[word].data, places_[word].bytes);
            if (level != at.expected[word]) return false;
        }
        return true;
    }

    std::string chosen_;
    VerilatedContext context_;
    std::unique_ptr<Vtop> top_;
    std::vector<Place> places_;
};

using Ranges = std::vector<std::pair<std::size_t, std::size_t>>;

// The layout of a model: bytes that two models may have in common, and bytes of registers.
class Layout {
  public:
    // Read the size of all variables from the standard input, then place and size of each register.
    explicit Layout(int every) {
        Model one(every, recordings.front()), other(-every - 1, recordings.front());
        for (Model* const model : {&one, &other}) {
            Cursor at(recordings.front());
            model->run(at, recordings.front().end);
        }
        for (std::size_t at = 0; at < SIZE; ++at) {
            if (one.state()[at] != other.state()[at]) continue;  // the number of the mutant
            if (common_.empty() || common_.back().second != at) common_.push_back({at, at});
            ++common_.back().second;
        }
        std::size_t end, first, size;
        if (!(std::cin >> end) || end != SIZE) std::abort();
        while (std::cin >> first >> size) registers_.push_back({first, first + size});
        for (std::size_t n = 0; n < recordings.size(); n += (recordings.size() + CHECKED - 1) / CHECKED)
            check(recordings[n], every);
    }
    void copy(char* to, const char* from) const {
        for (const auto& [first, end] : common_) std::memcpy(to + first, from + first, end - first);
    }
    bool same_registers(const char* left, const char* right) const {
        return std::all_of(registers_.begin(), registers_.end(), [&](const auto& range) {
            return !std::memcmp(left + range.first, right + range.first, range.second - range.first);
        });
    }

  private:
    // The registers alone must determine what follows. They are copied into a model that is in another state.
    void check(const Recording& recording, int every) const {
        Model one(every, recording), other(every, recording);
        Cursor at(recording), early(recording);
        one.run(at, recording.end / 2);
        other.run(early, recording.end / 4);
        for (const auto& [first, end] : registers_)
            std::memcpy(other.state() + first, one.state() + first, end - first);
        other.settle();
        Cursor copy = at;
        while (at.more()) {
            if (!one.run(at, BLOCK)) break;
            if (!other.run(copy, BLOCK) || !same_registers(one.state(), other.state())) {
                std::fputs("a register is missing in the layout of the model\n", stderr);
                std::exit(1);
            }
        }
    }

    Ranges common_, registers_;
};

// The kinds of steps of the RTL: a kind is a set of the bytes that change.
class Kinds {
  public:
    void begin(const char* state) { std::memcpy(last_.data(), state, SIZE); }
    // Return the number of the kind of the step that led to this state.
    std::size_t of(const char* state) {
        Word hash = 0;
        for (std::size_t n = 0; n < SIZE / 8; ++n) {
            const Word now = word_at(state + 8 * n);
            for (Word at = n * 8, left = now ^ last_[n]; left != 0; ++at, left >>= 8)
                if (left & 0xFF) hash = (hash ^ at) * 0x9E37'79B9'7F4A'7C15, hash ^= hash >> 29;
            last_[n] = now;
        }
        return known_.emplace(hash, known_.size()).first->second;
    }

  private:
    std::vector<Word> last_ = std::vector<Word>(SIZE / 8);
    std::unordered_map<Word, std::size_t> known_;
};

struct Mutant {
    Word left;                     // number of cycles for which it may still be simulated
    std::unique_ptr<Model> model;  // after it was first noted
    std::vector<char> futile;      // number of blocks with a step of this kind in which no output differed
    int bored;                     // number of successive blocks in which nothing new happened

    bool knows(const std::vector<std::size_t>& kinds) const {
        return std::all_of(kinds.begin(), kinds.end(),
                           [&](std::size_t kind) { return kind < futile.size() && futile[kind] >= TRIALS; });
    }
    void learn(const std::vector<std::size_t>& kinds) {
        bored = knows(kinds) ? bored + 1 : 0;
        futile.resize(std::max(futile.size(), *std::max_element(kinds.begin(), kinds.end()) + 1));
        for (const std::size_t kind : kinds) futile[kind] = static_cast<char>(std::min(futile[kind] + 1, TRIALS));
    }
};

// Return whether the mutant alone differs from the recording.
bool differs(const Recording& recording, int number) {
    const pid_t copy = fork();
    if (copy == 0) {
        Cursor at(recording);
        _exit(!Model(number, recording).run(at, recording.end + RESET + 1));
    }
    int status = 0;
    if (copy < 0 || waitpid(copy, &status, 0) != copy) std::abort();
    return WIFEXITED(status) && WEXITSTATUS(status) == 1;
}

// Return the mutants that differ from the recording; none if the RTL differs, too. A mutant whose levels do not become
// stable is removed from the mutants.
std::vector<int> killed(const Recording& recording, int every, const Layout& layout, Kinds& all_kinds,
                        std::map<int, Mutant>& mutants) {
    std::vector<int> found;
    std::list<int> alive;
    std::vector<char> before(SIZE), tried(noted.size(), false);
    Model rtl(every, recording);
    Cursor at(recording);
    rtl.run(at, 1);
    all_kinds.begin(rtl.state());
    while (at.more()) {
        const Cursor first = at;
        std::memcpy(before.data(), rtl.state(), SIZE);
        std::fill(noted.begin(), noted.end(), false);
        std::vector<std::size_t> kinds;
        for (Word step = 0; step < BLOCK; ++step) {
            if (!rtl.run(at, 1)) return {};
            const std::size_t kind = all_kinds.of(rtl.state());
            if (std::find(kinds.begin(), kinds.end(), kind) == kinds.end()) kinds.push_back(kind);
        }
        for (auto& [number, mutant] : mutants) {
            if (!noted[number] || tried[number] || mutant.left < BLOCK || mutant.knows(kinds)) continue;
            if (!mutant.model) {
                mutant.model = std::make_unique<Model>(number, recording);
                mutant.model->select(recording);
            }
            layout.copy(mutant.model->state(), before.data());
            alive.push_back(number);
            tried[number] = true;
            mutant.bored = 0;
        }
        for (auto one = alive.begin(); one != alive.end();) {
            const auto now = one++;
            Mutant& mutant = mutants.at(*now);
            Cursor mine = first;
            bool agrees = false;
            try {
                agrees = mutant.model->run(mine, BLOCK);
            } catch (const std::runtime_error&) {
                mutants.erase(*now);
                alive.erase(now);
                continue;
            }
            mutant.left -= std::min(mutant.left, BLOCK);
            if (agrees) {
                mutant.learn(kinds);
                tried[*now] = mutant.bored < PATIENCE && mutant.left >= BLOCK &&
                              !layout.same_registers(mutant.model->state(), rtl.state());
                if (tried[*now]) continue;
            } else {
                found.push_back(*now);
            }
            alive.erase(now);
        }
    }
    return found;
}

}  // namespace

// The design calls this function.
int openppmc_note(int number);
int openppmc_note(int number) {
    if (static_cast<std::size_t>(number) < noted.size()) noted[number] = true;
    return 0;
}

// Verilator calls this function if levels do not become stable.
void vl_fatal(const char*, int, const char*, const char* message) { throw std::runtime_error(message); }

int main(int argc, char** argv) {
    read(argv[1]);
    const int every = std::stoi(argv[2]);
    std::map<int, Mutant> mutants;
    for (int n = 4; n < argc; ++n) mutants[std::stoi(argv[n])].left = std::stoull(argv[3]);
    noted.assign(mutants.rbegin()->first + 1, false);
    const Layout layout(every);
    Kinds kinds;
    for (const Recording& recording : recordings) {
        for (const int number : killed(recording, every, layout, kinds, mutants)) {
            if (!differs(recording, number)) continue;
            mutants.erase(number);
            std::printf("%d %llu\n", number, static_cast<unsigned long long>(recording.number));
            std::fflush(stdout);
        }
    }
}
