// SPDX-License-Identifier: GPL-3.0-or-later
namespace ice {

int of_sixty_lines() {
  // 59 more lines
}

int of_sixty_one(int a,
                 int b) {
  // 59 more lines
    return a + b;
}

class Long {
public:
    Long() : a_(0) {
  // 59 more lines
        a_ = 1;
    }

private:
    int a_;
};

}  // namespace ice
