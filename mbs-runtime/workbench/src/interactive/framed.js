// In a frame of another page, such as that of an editor: what was looked at lives on when the mechanism changes.
(() => {
  if (parent === window) return;
  addEventListener("message", ({ source, data }) => {
    if (source !== parent || !data) return;
    scrollTo(0, data.scroll);
    if (data.speed) mechanism.player.speed = data.speed;
    if (data.isPlaying) mechanism.player.play();
  });
  const tell = () => parent.postMessage({ scroll: scrollY, ...mechanism.player.state }, "*");
  addEventListener("scroll", tell, { passive: true });
  mechanism.player.changed = tell;
  // the page around this one answers with what was looked at
  parent.postMessage("drawn", "*");
})();
