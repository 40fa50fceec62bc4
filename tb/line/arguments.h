// SPDX-License-Identifier: Apache-2.0
// Arguments name=value of the virtual line. The name of an argument of a station ends in the number of the
// station on the line, from 0. openppmc.sim checks the arguments for the user. Here, an error only ends the
// program.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <map>
#include <stdexcept>
#include <string>

class Arguments {
   public:
    Arguments(int argc, char** argv) {
        for (int i = 1; i < argc; ++i) {
            const std::string word = argv[i];
            const size_t equals = word.find('=');
            if (equals == std::string::npos) throw std::runtime_error(word + ": no such option");
            values_[word.substr(0, equals)] = word.substr(equals + 1);
        }
    }

    bool has(const std::string& name) const { return values_.count(name) != 0; }

    std::string text(const std::string& name, const std::string& without = "") const {
        const auto found = values_.find(name);
        return found == values_.end() ? without : found->second;
    }

    int64_t whole(const std::string& name, int64_t without = 0) const {
        return has(name) ? std::strtoll(text(name).c_str(), nullptr, 10) : without;
    }

    double real(const std::string& name, double without) const {
        return has(name) ? std::strtod(text(name).c_str(), nullptr) : without;
    }

   private:
    std::map<std::string, std::string> values_;
};

// Arguments of one station.
class StationArguments {
   public:
    StationArguments(const Arguments& all, unsigned place) : all_(all), place_(std::to_string(place)) {}

    bool has(const std::string& name) const { return all_.has(name + place_); }
    std::string text(const std::string& name) const { return all_.text(name + place_); }
    int64_t whole(const std::string& name, int64_t without = 0) const { return all_.whole(name + place_, without); }
    const Arguments& line() const { return all_; }

   private:
    const Arguments& all_;
    std::string place_;
};
