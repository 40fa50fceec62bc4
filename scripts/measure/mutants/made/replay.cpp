// SPDX-License-Identifier: Apache-2.0
// Main program that replays recordings of tests into the mutants of a design:
//     Vtop RECORDINGS EVERY BUDGET FILES MUTANT ...
// FILES is the number of mutants by which the numbers of two files differ. It first replays each recording without a
// mutant, and notes the mutants that have another value than the RTL; only these mutants are tried with this recording.
// Of each file, the recordings are tried first that note the most of its mutants in the fewest cycles. For each mutant
// in which an output differs within BUDGET cycles, the program prints its number, and the number of the recording.
// replay.py writes the file of recordings, which consists of 64-bit words and names.
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <list>
#include <map>
#include <string>
#include <vector>

#include "Vtop.h"
#include "verilated.h"
#include "verilated_syms.h"

namespace {

using Word = std::uint64_t;

struct Row {
    Word t, port, level;
};
struct Recording {
    Word number, end;
    std::vector<Word> levels;  // of all words of all ports at the start
    std::vector<Row> inputs, outputs;
    std::vector<char> noted;  // by number of the mutant: whether it has another value than the RTL
};

constexpr double START = 1'000;  // the start of a replay takes as long as this number of cycles

std::vector<std::string> ports;  // clk, rst_n, the other inputs, the outputs
Word inputs = 0;                 // number of words of the inputs
std::list<Recording> recordings;
std::vector<char> noted;

class Reader {
  public:
    explicit Reader(const char* path)
        : file_(path, std::ios::binary), data_(std::istreambuf_iterator<char>(file_), {}) {}
    bool more() const { return at_ < data_.size(); }
    Word word() {
        Word value;
        std::memcpy(&value, &data_.at((at_ += 8) - 1) - 7, 8);
        return value;
    }
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
        Recording recording{reader.word(), reader.word(), std::vector<Word>(words), {}, {}, {}};
        for (Word& level : recording.levels) level = reader.word();
        recording.inputs = reader.rows();
        recording.outputs = reader.rows();
        recordings.push_back(std::move(recording));
    }
}

// Return whether an output differs from the recording.
bool differs(const Recording& recording, const std::string& mutant) {
    const std::string chosen = "+mutant=" + mutant;
    const char* words[] = {"replay", chosen.c_str()};
    VerilatedContext context;
    context.commandArgs(2, words);
    context.randReset(2);
    context.randSeed(1);
    context.assertOn(false);
    Vtop top{&context, ""};
    struct Place {
        char* data;
        std::size_t bytes;
    };
    std::vector<Place> places;
    for (const std::string& port : ports) {
        const VerilatedVar* const var = context.scopeFind("TOP")->varFind(port.c_str());
        for (std::size_t at = 0; at < var->entSize(); at += 8)
            places.push_back({static_cast<char*>(var->datap()) + at, std::min<std::size_t>(8, var->entSize() - at)});
    }
    const auto put = [&](Word word, Word level) { std::memcpy(places[word].data, &level, places[word].bytes); };
    const auto edge = [&] {
        put(0, 1);
        top.eval();
        put(0, 0);
    };
    auto input = recording.inputs.begin();
    std::vector<Word> expected = recording.levels;
    for (Word word = 2; word < inputs; ++word) put(word, expected[word]);
    for (; input != recording.inputs.end() && input->t == 0; ++input) put(input->port, input->level);
    put(0, 0);
    put(1, 1);
    top.eval();
    put(1, 0);
    top.eval();
    for (int cycle = 0; cycle < 4; ++cycle) {
        edge();
        top.eval();
    }
    put(1, 1);
    auto output = recording.outputs.begin();
    Word quiet = 0;  // an asynchronous reset may act one cycle earlier or later
    for (Word t = 0; t <= recording.end; ++t) {
        for (; input != recording.inputs.end() && input->t == t; ++input) {
            if (input->port == 1) quiet = t + 2;
            put(input->port, input->level);
        }
        top.eval();
        edge();
        for (; output != recording.outputs.end() && output->t == t; ++output) expected[output->port] = output->level;
        if (t < quiet) continue;
        for (Word word = inputs; word < places.size(); ++word) {
            Word level = 0;
            std::memcpy(&level, places[word].data, places[word].bytes);
            if (level != expected[word]) return true;
        }
    }
    return false;
}

// Like differs, but in a copy of this process, because a mutant whose levels do not become stable aborts the process. Its
// tests show whether they fail.
bool differs_safely(const Recording& recording, const std::string& mutant) {
    const pid_t copy = fork();
    if (copy == 0) _exit(differs(recording, mutant));
    int status = 0;
    if (copy < 0 || waitpid(copy, &status, 0) != copy) std::abort();
    return WIFEXITED(status) && WEXITSTATUS(status) == 1;
}

// Return the recordings in the order in which they are tried for the mutants [first, last) of a file. Each round of
// the order consists of few and short recordings that note all these mutants.
std::list<const Recording*> order(int first, int last) {
    std::list<const Recording*> found;
    std::vector<const Recording*> left;
    for (const Recording& recording : recordings) left.push_back(&recording);
    std::vector<char> wanted(last - first, true);
    const auto value = [&](const Recording* recording) {
        int count = 0;
        for (int n = first; n < last; ++n) count += wanted[n - first] && recording->noted[n];
        return count / (START + static_cast<double>(recording->end));
    };
    while (!left.empty()) {
        std::vector<double> values;
        for (const Recording* recording : left) values.push_back(value(recording));
        const auto best = std::max_element(values.begin(), values.end());
        if (*best > 0) {
            const auto at = left.begin() + (best - values.begin());
            found.push_back(*at);
            for (int n = first; n < last; ++n)
                if ((*at)->noted[n]) wanted[n - first] = false;
            left.erase(at);
        } else if (std::find(wanted.begin(), wanted.end(), false) != wanted.end()) {
            wanted.assign(wanted.size(), true);
        } else {
            break;
        }
    }
    return found;
}

}  // namespace

// The design calls this function.
extern "C" int openppmc_note(int number) {
    noted[number] = true;
    return 0;
}

int main(int argc, char** argv) {
    read(argv[1]);
    const int files = std::stoi(argv[4]), end = (std::stoi(argv[argc - 1]) / files + 1) * files;
    for (auto at = recordings.begin(); at != recordings.end();) {
        const auto now = at++;
        noted.assign(end, false);
        // The replay cannot repeat every test, for example one that changes rst_n between two edges.
        if (differs(*now, argv[2]))
            recordings.erase(now);
        else
            now->noted.swap(noted);
    }
    std::map<int, std::list<const Recording*>> orders;
    for (int n = 5; n < argc; ++n) {
        const int mutant = std::stoi(argv[n]), file = mutant / files * files;
        if (!orders.count(file)) orders[file] = order(file, file + files);
        auto& mine = orders[file];
        Word left = std::stoull(argv[3]);
        for (auto at = mine.begin(); at != mine.end(); ++at) {
            if (!(*at)->noted[mutant] || left < (*at)->end) continue;
            left -= (*at)->end;
            if (!differs_safely(**at, argv[n])) continue;
            std::printf("%d %llu\n", mutant, static_cast<unsigned long long>((*at)->number));
            std::fflush(stdout);
            // The next mutant of the file is probably found by the same recording.
            mine.splice(mine.begin(), mine, at);
            break;
        }
    }
}
