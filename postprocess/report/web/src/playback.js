// SPDX-License-Identifier: GPL-3.0-or-later
// The clock that pictures and plots follow.

export class Playback {
  constructor(first, last) {
    this.first = first;
    this.last = last;
    this.time = first;
    this.speed = 1;
    this.playing = false;
    this.listeners = [];
  }

  /** @param listener called with the time [s] at each change of time or state */
  onChange(listener) {
    this.listeners.push(listener);
  }

  tell() {
    for (const listener of this.listeners) listener(this.time);
  }

  seek(time) {
    this.time = Math.min(this.last, Math.max(this.first, time));
    this.tell();
  }

  toggle() {
    this.playing = !this.playing;
    if (this.playing && this.time >= this.last) this.time = this.first;
    this.before = performance.now();
    if (this.playing) requestAnimationFrame((now) => this.tick(now));
    this.tell();
  }

  tick(now) {
    if (!this.playing) return;
    const step = (Math.max(0, now - this.before) / 1000) * this.speed;
    this.before = now;
    if (this.time + step >= this.last) this.playing = false;
    this.seek(this.time + step);
    if (this.playing) requestAnimationFrame((next) => this.tick(next));
  }
}
