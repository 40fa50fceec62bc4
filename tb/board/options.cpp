// SPDX-License-Identifier: Apache-2.0
#include "options.h"

#include <cstdlib>
#include <cstring>
#include <functional>
#include <map>
#include <stdexcept>

namespace {

template <class Number>
Number whole(const std::string& text, Number value, const char* end) {
    if (text.empty() || *end) throw std::runtime_error(text + ": not a number");
    return value;
}

int64_t integer(const std::string& text) {
    char* end;
    const int64_t value = std::strtoll(text.c_str(), &end, 10);
    return whole(text, value, end);
}

double real(const std::string& text) {
    char* end;
    const double value = std::strtod(text.c_str(), &end);
    return whole(text, value, end);
}

}  // namespace

Options parse_options(int argc, char** argv) {
    Options o;
    using Setter = std::function<void(const std::string&)>;
    const auto position = [](int64_t& to) { return Setter([&to](const std::string& text) { to = integer(text); }); };
    std::map<std::string, Setter> setters = {
        {"speed", [&o](const std::string& text) { o.speed = text == "max" ? 0 : real(text); }},
        {"vcd", [&o](const std::string& text) { o.vcd = text; }},
        {"vcd_from", [&o](const std::string& text) { o.vcd_from = real(text); }},
        {"vcd_for", [&o](const std::string& text) { o.vcd_for = real(text); }},
        {"log", [&o](const std::string& text) { o.log = text; }},
    };
    for (unsigned n = 0; n < kAxes; ++n) {
        PlantText& plant = o.plants[n];
        const std::string of = n ? std::to_string(n + 1) : "";
        setters["start" + of] = position(plant.start);
        setters["cw" + of] = position(plant.cw);
        setters["ccw" + of] = position(plant.ccw);
        setters["slow_cw" + of] = position(plant.slow_cw);
        setters["slow_ccw" + of] = position(plant.slow_ccw);
        setters["origin" + of] = position(plant.origin);
        setters["origin_from" + of] = position(plant.origin_from);
        setters["index" + of] = position(plant.index);
        setters["block" + of] = [&plant](const std::string& text) { plant.block = integer(text); };
        setters["alarm" + of] = [&plant](const std::string& text) {
            const size_t dots = text.find("..");
            if (dots == std::string::npos) throw std::runtime_error("alarm=" + text + ": not a range");
            plant.alarm_from = integer(text.substr(0, dots));
            plant.alarm_to = integer(text.substr(dots + 2));
        };
    }
    for (int i = 1; i < argc; ++i) {
        const char* equals = std::strchr(argv[i], '=');
        const auto setter = setters.find(std::string(argv[i], equals ? equals - argv[i] : std::strlen(argv[i])));
        if (!equals || setter == setters.end()) throw std::runtime_error(std::string(argv[i]) + ": no such option");
        setter->second(equals + 1);
    }
    return o;
}
