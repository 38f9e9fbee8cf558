// SHA-256 (FIPS 180-4), so that a page compares bits where the browser offers no digest.
#include <string.h>
#include "vector.h"

typedef unsigned int Word;

static const Word K[64] = {
    0x428a2f98, 0x71374491, 0xb5c0fbcf, 0xe9b5dba5, 0x3956c25b, 0x59f111f1, 0x923f82a4, 0xab1c5ed5,
    0xd807aa98, 0x12835b01, 0x243185be, 0x550c7dc3, 0x72be5d74, 0x80deb1fe, 0x9bdc06a7, 0xc19bf174,
    0xe49b69c1, 0xefbe4786, 0x0fc19dc6, 0x240ca1cc, 0x2de92c6f, 0x4a7484aa, 0x5cb0a9dc, 0x76f988da,
    0x983e5152, 0xa831c66d, 0xb00327c8, 0xbf597fc7, 0xc6e00bf3, 0xd5a79147, 0x06ca6351, 0x14292967,
    0x27b70a85, 0x2e1b2138, 0x4d2c6dfc, 0x53380d13, 0x650a7354, 0x766a0abb, 0x81c2c92e, 0x92722c85,
    0xa2bfe8a1, 0xa81a664b, 0xc24b8b70, 0xc76c51a3, 0xd192e819, 0xd6990624, 0xf40e3585, 0x106aa070,
    0x19a4c116, 0x1e376c08, 0x2748774c, 0x34b0bcb5, 0x391c0cb3, 0x4ed8aa4a, 0x5b9cca4f, 0x682e6ff3,
    0x748f82ee, 0x78a5636f, 0x84c87814, 0x8cc70208, 0x90befffa, 0xa4506ceb, 0xbef9a3f7, 0xc67178f2};

static Word rotated(Word a, int by) { return a >> by | a << (32 - by); }

static void take_in(Word *H, const unsigned char *block) {
  Word w[64], s[8];
  for (int i = 0; i < 16; i++)
    w[i] = (Word)block[4 * i] << 24 | block[4 * i + 1] << 16 | block[4 * i + 2] << 8 | block[4 * i + 3];
  for (int i = 16; i < 64; i++) {
    Word a = w[i - 15], b = w[i - 2];
    w[i] = w[i - 16] + w[i - 7] + (rotated(a, 7) ^ rotated(a, 18) ^ a >> 3) + (rotated(b, 17) ^ rotated(b, 19) ^ b >> 10);
  }
  memcpy(s, H, sizeof s);
  for (int i = 0; i < 64; i++) {
    Word e = s[4], a = s[0];
    Word first = s[7] + (rotated(e, 6) ^ rotated(e, 11) ^ rotated(e, 25)) + ((e & s[5]) ^ (~e & s[6])) + K[i] + w[i];
    Word second = (rotated(a, 2) ^ rotated(a, 13) ^ rotated(a, 22)) + ((a & s[1]) ^ (a & s[2]) ^ (s[1] & s[2]));
    memmove(s + 1, s, 7 * sizeof(Word));
    s[4] += first, s[0] = first + second;
  }
  for (int i = 0; i < 8; i++) H[i] += s[i];
}

// The digest of `bytes` bytes as 64 hexadecimal characters.
EXPORT void sha256(const unsigned char *data, int bytes, char *out) {
  Word H[8] = {0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a, 0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
  unsigned char end[128] = {0};
  int whole = bytes / 64 * 64, rest = bytes - whole, last = rest < 56 ? 64 : 128;
  for (int i = 0; i < whole; i += 64) take_in(H, data + i);
  memcpy(end, data + whole, rest), end[rest] = 0x80;
  unsigned long long bits = (unsigned long long)bytes * 8;
  for (int i = 0; i < 8; i++) end[last - 1 - i] = bits >> (8 * i);
  for (int i = 0; i < last; i += 64) take_in(H, end + i);
  for (int i = 0; i < 64; i++) out[i] = "0123456789abcdef"[H[i / 8] >> (28 - 4 * (i % 8)) & 15];
}
