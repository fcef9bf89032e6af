import type { Player } from "./player";

/** Plays from the start unless that is not wanted, and rests while nobody can see the stage. */
export function autoplay(player: Player, host: HTMLElement): void {
  let interrupted = wantsMotion();
  let inView = true;
  const judge = (): void => {
    const seen = inView && !document.hidden;
    if (!seen && player.playing) {
      player.pause();
      interrupted = true;
    } else if (seen && interrupted) {
      interrupted = false;
      player.play();
    }
  };
  new IntersectionObserver((entries) => {
    inView = entries[entries.length - 1]?.isIntersecting ?? true;
    judge();
  }).observe(host);
  document.addEventListener("visibilitychange", judge);
}

export function wantsMotion(): boolean {
  return !window.matchMedia("(prefers-reduced-motion: reduce)").matches;
}
