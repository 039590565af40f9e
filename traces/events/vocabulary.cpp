#include "traces/events/vocabulary.hpp"

#include <typeinfo>

namespace zstep::detail {

void wrong_kind() { throw std::bad_cast(); }

}  // namespace zstep::detail
