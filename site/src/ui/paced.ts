// Limits the rate of a drawing function: it runs in an animation frame, and then pauses for SHARE times its
// duration.

const SHARE = 4; // pause after a drawing, as a multiple of its duration

export interface Paced {
  call: () => void;
  stop: () => void;
}

export function paced(work: () => void): Paced {
  let picture = 0;
  let pause = 0;
  let again = false;
  const run = (): void => {
    picture = 0;
    const begin = performance.now();
    work();
    pause = window.setTimeout(resume, SHARE * (performance.now() - begin));
  };
  const call = (): void => {
    if (pause) again = true;
    else picture ||= requestAnimationFrame(run);
  };
  const resume = (): void => {
    pause = 0;
    if (again) call();
    again = false;
  };
  return {
    call,
    stop: () => {
      cancelAnimationFrame(picture);
      clearTimeout(pause);
    },
  };
}
