// A file in memory, read only. What is written to the file while it is mapped shows; one that is cut shorter takes the
// process down when what was cut is read (jktools replaces files, and never writes into one).
#pragma once

#include <cerrno>
#include <cstddef>
#include <cstring>
#include <string>
#include <utility>

#if defined(_WIN32)
#if !defined(WIN32_LEAN_AND_MEAN)
#define WIN32_LEAN_AND_MEAN
#endif
#if !defined(NOMINMAX)
#define NOMINMAX
#endif
#include <windows.h>
#else
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>
#endif

namespace jklb {

class Mapping {
public:
    Mapping() = default;
    Mapping(const Mapping&) = delete;
    Mapping& operator=(const Mapping&) = delete;
    Mapping(Mapping&& other) noexcept { swap(other); }
    Mapping& operator=(Mapping&& other) noexcept {
        swap(other);
        return *this;
    }
    ~Mapping() { close(); }

    const void* data() const { return data_; }
    std::size_t size() const { return size_; }

    // False, with the reason in `why`, when the file cannot be opened or is empty. On Windows the path is UTF-8.
    bool open(const std::string& path, std::string& why);

private:
    void swap(Mapping& other) noexcept {
        std::swap(data_, other.data_);
        std::swap(size_, other.size_);
    }

    void close();

    void* data_ = nullptr;
    std::size_t size_ = 0;
};

#if defined(_WIN32)

inline bool Mapping::open(const std::string& path, std::string& why) {
    close();
    why = "the system does not open it";
    const int length = MultiByteToWideChar(CP_UTF8, 0, path.c_str(), -1, nullptr, 0);
    if (length <= 0) return false;
    std::wstring wide(static_cast<std::size_t>(length), L'\0');
    MultiByteToWideChar(CP_UTF8, 0, path.c_str(), -1, &wide[0], length);
    const HANDLE file = CreateFileW(wide.c_str(), GENERIC_READ, FILE_SHARE_READ, nullptr, OPEN_EXISTING, 0, nullptr);
    if (file == INVALID_HANDLE_VALUE) {
        const DWORD code = GetLastError(), kind = GetFileAttributesW(wide.c_str());
        if (code == ERROR_FILE_NOT_FOUND || code == ERROR_PATH_NOT_FOUND) why = "no such file or directory";
        if (kind != INVALID_FILE_ATTRIBUTES && (kind & FILE_ATTRIBUTE_DIRECTORY)) why = "is a directory";
        return false;
    }
    LARGE_INTEGER size;
    if (!GetFileSizeEx(file, &size)) {
        why = "it is no file";
    } else if (size.QuadPart == 0) {
        why = "the file is empty";
    } else if (const HANDLE mapping = CreateFileMappingW(file, nullptr, PAGE_READONLY, 0, 0, nullptr)) {
        data_ = MapViewOfFile(mapping, FILE_MAP_READ, 0, 0, 0);
        if (data_) size_ = static_cast<std::size_t>(size.QuadPart);
        CloseHandle(mapping);
    }
    CloseHandle(file);
    return data_ != nullptr;
}

inline void Mapping::close() {
    if (data_) UnmapViewOfFile(data_);
    data_ = nullptr;
    size_ = 0;
}

#else

inline bool Mapping::open(const std::string& path, std::string& why) {
    close();
    const auto fail = [&why] {
        why = std::strerror(errno);
        if (!why.empty() && why[0] >= 'A' && why[0] <= 'Z') why[0] = static_cast<char>(why[0] - 'A' + 'a');
        return false;
    };
    const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);  // a pipe is no reason to wait
    if (file < 0) return fail();
    struct stat status;
    bool good = ::fstat(file, &status) == 0;
    if (good && S_ISDIR(status.st_mode)) {
        errno = EISDIR;
        good = false;
    }
    if (!good) {
        fail();
    } else if (!S_ISREG(status.st_mode)) {
        why = "it is no file";
    } else if (status.st_size == 0) {
        why = "the file is empty";
    } else {
        void* data = ::mmap(nullptr, static_cast<std::size_t>(status.st_size), PROT_READ, MAP_PRIVATE, file, 0);
        if (data == MAP_FAILED) {
            fail();
        } else {
            data_ = data;
            size_ = static_cast<std::size_t>(status.st_size);
        }
    }
    ::close(file);
    return data_ != nullptr;
}

inline void Mapping::close() {
    if (data_) ::munmap(data_, size_);
    data_ = nullptr;
    size_ = 0;
}

#endif

}  // namespace jklb
