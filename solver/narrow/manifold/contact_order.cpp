// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/narrow/manifold/contact_order.hpp"

#include <algorithm>
#include <tuple>

namespace ice {

void sort_places(std::vector<ContactPlace>& places) {
    std::sort(places.begin(), places.end(),
              [](const ContactPlace& l, const ContactPlace& r) { return l.ranks < r.ranks; });
}

void order_equals(const std::vector<ContactPlace>& places, Contact* first) {
    // Runs of equal ranks are spheres and their mirror images. Gap, then x and z of the point order
    // their contacts; y, in which images differ, does not count, so a mirrored state has the
    // mirrored order.
    for (std::size_t k = 0; k < places.size();) {
        std::size_t end = k + 1;
        while (end < places.size() && places[end].ranks == places[k].ranks) ++end;
        if (end > k + 1)
            std::sort(first + k, first + end, [](const Contact& l, const Contact& r) {
                const auto rest = [](const Contact& c) {
                    return std::tuple(c.gap, c.point.x(), c.point.z(), c.key);
                };
                return rest(l) < rest(r);
            });
        k = end;
    }
}

}  // namespace ice
