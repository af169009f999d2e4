// Neither reads, answers nor ends.
#include <unistd.h>

int main() {
  for (;;) pause();
}
