#include "text/logical_lines.hpp"

#include <algorithm>
#include <stdexcept>

namespace jk {
namespace {

struct Piece {
    std::size_t begin, end;  // end lies behind the line feed when the piece has one
    bool tail;               // not the first piece of its physical line
    bool cut;                // the physical line goes on behind this piece
};

class Pieces {
public:
    Pieces(std::string_view text, std::size_t limit) : text_(text), limit_(limit) {}

    bool next(Piece& piece) {
        if (at_ >= text_.size()) return false;
        const std::size_t most = std::min(limit_, text_.size() - at_);
        const std::size_t feed = text_.substr(at_, most).find('\n');
        const bool ended = feed != std::string_view::npos;
        piece = {at_, ended ? at_ + feed + 1 : at_ + most, inside_, !ended && at_ + most < text_.size()};
        inside_ = piece.cut;
        at_ = piece.end;
        return true;
    }

private:
    std::string_view text_;
    std::size_t limit_;
    std::size_t at_ = 0;
    bool inside_ = false;
};

bool is_skipped(char first) { return first == ';' || first == '#' || first == '\r' || first == '\n'; }

bool is_blank(char c) { return c == ' ' || c == '\t' || c == ',' || c == '\r' || c == '\n'; }

}  // namespace

LogicalLines logical_lines(std::string_view text, std::size_t buffer_size) {
    if (buffer_size < 2) throw std::invalid_argument("buffer_size must be at least 2 bytes");
    LogicalLines out;
    Pieces pieces(text, buffer_size - 1);
    Piece piece{};
    bool joining = false;
    std::uint8_t flags = 0;

    const auto finish = [&] {
        out.line_segment.push_back(static_cast<std::int64_t>(out.segment_start.size()));
        out.flags.push_back(flags);
        joining = false;
        flags = 0;
    };

    while (pieces.next(piece)) {
        if (is_skipped(text[piece.begin])) continue;
        flags |= (piece.cut ? kCut : 0) | (piece.tail ? kTail : 0) | (joining ? kContinued : 0);

        std::size_t end = piece.end;
        const std::size_t hash = text.substr(piece.begin, end - piece.begin).find('#');
        if (hash != std::string_view::npos) {
            end = piece.begin + hash;
            if (hash > 0 && !is_blank(text[end - 1])) flags |= kCommentInWord;
        }
        joining = end - piece.begin >= 2 && text[end - 2] == '\\';
        if (joining) {
            end -= 2;
        } else {
            while (end > piece.begin && (text[end - 1] == '\n' || text[end - 1] == '\r')) --end;
        }
        out.segment_start.push_back(static_cast<std::int64_t>(piece.begin));
        out.segment_end.push_back(static_cast<std::int64_t>(end));
        if (!joining) finish();
    }
    if (joining) finish();
    return out;
}

}  // namespace jk
