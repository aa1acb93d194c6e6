// Maps the files that are named, each twice, the second over the first: what they hold, or why not. The exit status tells
// whether all was given back. Compiled as for Windows too, against tests/runtime/windows.
#include "jklb/mapping.hpp"

#include <cstdio>

namespace {

bool clean() {
#if defined(_WIN32)
    return stub::open_handles == 0 && stub::views.empty();
#else
    return true;
#endif
}

}  // namespace

int main(int count, char** words) {
    for (int i = 1; i < count; ++i) {
        jklb::Mapping mapping;
        std::string why;
        if (!mapping.open(words[i], why) || !mapping.open(words[i], why)) {
            std::printf("%s\n", why.c_str());
            if (mapping.data() || mapping.size()) return 3;
            continue;
        }
        jklb::Mapping moved(std::move(mapping));
        mapping = std::move(moved);
        std::printf("%zu %.*s\n", mapping.size(), static_cast<int>(mapping.size()), static_cast<const char*>(mapping.data()));
    }
    return clean() ? 0 : 3;
}
