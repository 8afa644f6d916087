// SPDX-License-Identifier: GPL-3.0-or-later
namespace ice {

int of_sixty_lines() {
  // 58 more lines
}

// its signature has two lines
void of_sixty_one(int a,
                  int b) {
  // 58 more lines
}
template <typename T>
void of_sixty_one_too(T) {
  // 58 more lines
}

class Long {
public:
    // of sixty lines
    void add(int a) {
  // 58 more lines
    }
    Long()
        : a_(0) {
  // 58 more lines
    }

private:
    int a_;
};

}  // namespace ice
