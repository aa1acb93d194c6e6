// The calls of Windows that jklb/mapping.hpp makes, over POSIX: so that its Windows part compiles and runs here.
//
// By what the functions' pages at learn.microsoft.com say: which are told of failure by 0, which by
// INVALID_HANDLE_VALUE; that CreateFileW does not open folders without FILE_FLAG_BACKUP_SEMANTICS; that a view keeps the
// file mapped when the handles are closed; and that an empty file cannot be mapped.
#pragma once

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <map>
#include <string>

using DWORD = std::uint32_t;
using BOOL = int;
using HANDLE = void*;
union LARGE_INTEGER {
    long long QuadPart;
};

constexpr unsigned CP_UTF8 = 65001;
constexpr DWORD GENERIC_READ = 0x80000000, FILE_SHARE_READ = 1, FILE_SHARE_DELETE = 4, OPEN_EXISTING = 3;
constexpr DWORD PAGE_READONLY = 2, FILE_MAP_READ = 4;
constexpr DWORD ERROR_FILE_NOT_FOUND = 2, ERROR_PATH_NOT_FOUND = 3, ERROR_ACCESS_DENIED = 5;
constexpr DWORD FILE_ATTRIBUTE_DIRECTORY = 0x10, INVALID_FILE_ATTRIBUTES = 0xffffffff;
inline const HANDLE INVALID_HANDLE_VALUE = reinterpret_cast<HANDLE>(std::intptr_t{-1});

namespace stub {

inline DWORD last_error = 0;
inline int open_handles = 0;
inline std::map<void*, std::size_t> views;

inline std::string narrow(const wchar_t* wide) {
    std::string text;
    for (; *wide; ++wide) {
        const auto c = static_cast<std::uint32_t>(*wide);
        const auto put = [&text](std::uint32_t octet) { text += static_cast<char>(octet); };
        if (c < 0x80) put(c);
        else if (c < 0x800) put(0xc0 | c >> 6), put(0x80 | (c & 0x3f));
        else if (c < 0x10000) put(0xe0 | c >> 12), put(0x80 | (c >> 6 & 0x3f)), put(0x80 | (c & 0x3f));
        else put(0xf0 | c >> 18), put(0x80 | (c >> 12 & 0x3f)), put(0x80 | (c >> 6 & 0x3f)), put(0x80 | (c & 0x3f));
    }
    return text;
}

inline int descriptor(HANDLE handle) { return static_cast<int>(reinterpret_cast<std::intptr_t>(handle)) - 1; }

inline HANDLE handle_of(int descriptor) {
    ++open_handles;
    return reinterpret_cast<HANDLE>(static_cast<std::intptr_t>(descriptor) + 1);
}

inline bool fails(DWORD code) {
    last_error = code;
    return false;
}

}  // namespace stub

inline DWORD GetLastError() { return stub::last_error; }

inline int MultiByteToWideChar(unsigned page, DWORD, const char* text, int length, wchar_t* out, int room) {
    if (page != CP_UTF8 || length != -1) return 0;
    std::wstring wide;
    for (const auto* at = reinterpret_cast<const unsigned char*>(text); *at;) {
        const int more = *at < 0x80 ? 0 : *at < 0xe0 ? 1 : *at < 0xf0 ? 2 : 3;
        auto c = static_cast<std::uint32_t>(more ? *at & (0x3f >> more) : *at);
        ++at;
        for (int i = 0; i < more; ++i) c = c << 6 | (*at++ & 0x3f);
        wide += static_cast<wchar_t>(c);
    }
    const int needed = static_cast<int>(wide.size()) + 1;
    if (room == 0) return needed;
    if (room < needed) return 0;
    for (int i = 0; i < needed; ++i) out[i] = wide.c_str()[i];
    return needed;
}

inline DWORD GetFileAttributesW(const wchar_t* path) {
    struct stat status;
    if (::stat(stub::narrow(path).c_str(), &status) != 0) return INVALID_FILE_ATTRIBUTES;
    return S_ISDIR(status.st_mode) ? FILE_ATTRIBUTE_DIRECTORY : 0x80;
}

inline HANDLE CreateFileW(const wchar_t* path, DWORD, DWORD, void*, DWORD, DWORD, HANDLE) {
    if (GetFileAttributesW(path) == FILE_ATTRIBUTE_DIRECTORY) {
        stub::fails(ERROR_ACCESS_DENIED);
        return INVALID_HANDLE_VALUE;
    }
    const int file = ::open(stub::narrow(path).c_str(), O_RDONLY);
    if (file >= 0) return stub::handle_of(file);
    stub::fails(errno == ENOENT ? ERROR_FILE_NOT_FOUND : errno == ENOTDIR ? ERROR_PATH_NOT_FOUND : ERROR_ACCESS_DENIED);
    return INVALID_HANDLE_VALUE;
}

inline BOOL GetFileSizeEx(HANDLE file, LARGE_INTEGER* size) {
    struct stat status;
    if (::fstat(stub::descriptor(file), &status) != 0 || S_ISCHR(status.st_mode)) return stub::fails(1);
    size->QuadPart = status.st_size;
    return true;
}

inline HANDLE CreateFileMappingW(HANDLE file, void*, DWORD, DWORD, DWORD, const wchar_t*) {
    struct stat status;
    if (::fstat(stub::descriptor(file), &status) != 0 || status.st_size == 0) return stub::fails(1006), nullptr;
    return stub::handle_of(::dup(stub::descriptor(file)));
}

inline void* MapViewOfFile(HANDLE mapping, DWORD, DWORD, DWORD, std::size_t) {
    struct stat status;
    ::fstat(stub::descriptor(mapping), &status);
    const auto size = static_cast<std::size_t>(status.st_size);
    void* view = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, stub::descriptor(mapping), 0);
    if (view == MAP_FAILED) return nullptr;
    stub::views[view] = size;
    return view;
}

inline BOOL UnmapViewOfFile(const void* view) {
    const auto found = stub::views.find(const_cast<void*>(view));
    if (found == stub::views.end()) return false;
    ::munmap(found->first, found->second);
    stub::views.erase(found);
    return true;
}

inline BOOL CloseHandle(HANDLE handle) {
    --stub::open_handles;
    return ::close(stub::descriptor(handle)) == 0;
}
