/** Where in its run the page is, and how it goes on. */

export class Playback {
  /** Times of the frames (s). */
  times: Float64Array = new Float64Array([0]);
  time = 0;
  /** Seconds of the run in a second. */
  rate = 1;
  playing = false;
  /** A moment that is looked at while the pointer is over a curve. */
  glimpse: number | undefined;

  get start(): number {
    return this.times[0] ?? 0;
  }

  get end(): number {
    return this.times[this.times.length - 1] ?? 0;
  }

  /** The moment that is shown. */
  get shown(): number {
    return this.glimpse ?? this.time;
  }

  seek(time: number): void {
    this.time = Math.min(this.end, Math.max(this.start, time));
  }

  /** At the release. */
  begin(playing: boolean): void {
    this.time = this.start;
    this.glimpse = undefined;
    this.playing = playing;
  }

  play(): void {
    if (this.time >= this.end) {
      this.time = this.start;
    }
    this.playing = true;
  }

  /** To the next frame, or so many back. */
  step(frames: number): void {
    this.playing = false;
    const frame = Math.min(this.times.length - 1, Math.max(0, frameAt(this.times, this.time).frame + frames));
    this.time = this.times[frame] ?? this.time;
  }

  /** Goes on by some seconds of the clock; whether it came to the end. */
  advance(seconds: number): boolean {
    if (!this.playing) {
      return false;
    }
    this.seek(this.time + seconds * this.rate);
    if (this.time >= this.end) {
      this.playing = false;
      return true;
    }
    return false;
  }
}

/** The last frame that is not after `time`, and the share of the way to the next. */
export function frameAt(times: Float64Array, time: number): { frame: number; share: number } {
  let [low, high] = [0, times.length - 1];
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if ((times[middle] ?? 0) <= time) {
      low = middle;
    } else {
      high = middle - 1;
    }
  }
  const [before, after] = [times[low] ?? 0, times[low + 1]];
  const share = after === undefined || after <= before ? 0 : (time - before) / (after - before);
  return { frame: low, share: Math.min(1, Math.max(0, share)) };
}
