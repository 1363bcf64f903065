#pragma once

#include <memory>
#include <utility>

#include "io/document/schema/target.h"

namespace ifov::io {

/// Where a row puts what its record shares: a pointer to a member that is null where the key is not given.
template <class T, class V>
auto shared(std::shared_ptr<const V> T::*member) {
  return via([member](T& record, V value) { record.*member = std::make_shared<const V>(std::move(value)); },
             [member](const T& record) { return (record.*member).get(); });
}

}  // namespace ifov::io
