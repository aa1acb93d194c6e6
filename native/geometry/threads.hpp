// Work shared out among threads; what a row's answer is does not depend on how many.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <thread>
#include <vector>

namespace jk {

// Rows that a thread takes at a time: enough to hide the taking, few enough to share out a small batch.
inline constexpr std::size_t kChunk = 512;

// Calls work(first, end) for ranges of at most `chunk` rows that make up the rows below `rows`, on `threads` threads
// (0: one a core), this one included.
template <typename Work>
void share_out_ranges(std::size_t rows, std::size_t chunk, unsigned threads, const Work& work) {
    if (threads == 0) threads = std::max(1u, std::thread::hardware_concurrency());
    threads = static_cast<unsigned>(std::min<std::size_t>(threads, (rows + chunk - 1) / chunk));
    std::atomic<std::size_t> next{0};
    const auto run = [&] {
        for (std::size_t first; (first = next.fetch_add(chunk)) < rows;) work(first, std::min(rows, first + chunk));
    };
    std::vector<std::jthread> others;
    for (unsigned i = 1; i < threads; ++i) others.emplace_back(run);
    run();
}

// The same, row by row.
template <typename Work>
void share_out(std::size_t rows, unsigned threads, const Work& work) {
    share_out_ranges(rows, kChunk, threads, [&](std::size_t first, std::size_t end) {
        for (std::size_t row = first; row < end; ++row) work(row);
    });
}

}  // namespace jk
