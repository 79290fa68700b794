"use strict";
(() => {
  const form = document.getElementById("filter");
  const claims = [...document.querySelectorAll("article.claim")];
  const sections = [...document.querySelectorAll(".of-section")];
  const shown = document.getElementById("shown");
  const none = document.getElementById("none");
  const texts = new Map();
  let timer = 0;

  // The parts of the page that stand in it as data: JSON, compressed, in base 85, with formulas and outlines by number. Without them the page is a list.
  let parts = null;
  let shared = [];
  const unpacked = async () => {
    const text = document.getElementById("parts").textContent.replaceAll("v", "<");
    const bytes = new DataView(new ArrayBuffer(Math.ceil(text.length / 5) * 4));
    for (let at = 0; at < text.length; at += 5) {
      const digits = [...text.slice(at, at + 5).padEnd(5, "u")];
      bytes.setUint32(at / 5 * 4, digits.reduce((word, sign) => 85 * word + sign.charCodeAt(0) - 33, 0));
    }
    const stream = new Blob([bytes.buffer.slice(0, Math.floor(text.length * 4 / 5))]).stream().pipeThrough(new DecompressionStream("deflate"));
    ({ parts, shared } = JSON.parse(await new Response(stream).text()));
  };

  // Puts parts in their places within an element.
  const fill = (element) => {
    for (const place of parts ? element.querySelectorAll("[data-part]") : []) {
      place.outerHTML = parts[place.dataset.part].replace(/#(\d+);/g, (_, number) => shared[number]);
    }
  };

  const plain = (text) => text.toLowerCase().replace(/\s+/g, " ");

  // What a search looks through: all words of a claim, and the LaTeX of its formulas, which is their alternative text.
  const textOf = (claim) => {
    if (!texts.has(claim)) {
      const whole = document.createElement("template");
      whole.innerHTML = claim.outerHTML;
      fill(whole.content);
      const formulas = [...whole.content.querySelectorAll("math")].map((math) => math.getAttribute("alttext") || "");
      texts.set(claim, plain(whole.content.textContent + " " + formulas.join(" ")));
    }
    return texts.get(claim);
  };

  const unfold = (place) => {
    for (let box = place.closest("details"); box; box = box.parentElement.closest("details")) {
      fill(box);
      box.open = true;
    }
  };

  const wanted = () => ({
    verdicts: [...form.elements.verdict].filter((box) => box.checked).map((box) => box.value),
    section: form.elements.section.value,
    words: plain(form.elements.q.value).split(" ").filter(Boolean),
  });

  const apply = () => {
    const { verdicts, section, words } = wanted();
    let count = 0;
    for (const claim of claims) {
      const fits = (!verdicts.length || verdicts.includes(claim.dataset.verdict)) &&
        (!section || claim.parentElement.id === "section-" + section) && words.every((word) => textOf(claim).includes(word));
      claim.hidden = !fits;
      count += fits;
    }
    for (const one of sections) one.hidden = !one.querySelector("article.claim:not([hidden])");
    none.hidden = count > 0;
    shown.textContent = `${count} of ${claims.length} claims shown`;
  };

  const address = () => {
    const { verdicts, section } = wanted();
    const q = form.elements.q.value.trim();
    const parts = [];
    if (verdicts.length) parts.push("verdict=" + verdicts.map(encodeURIComponent).join(","));
    if (section) parts.push("section=" + encodeURIComponent(section));
    if (q) parts.push("q=" + encodeURIComponent(q));
    return parts.length ? "#?" + parts.join("&") : "#claims";
  };

  const choose = (query) => {
    const asked = new URLSearchParams(query);
    const verdicts = (asked.get("verdict") || "").split(",");
    for (const box of form.elements.verdict) box.checked = verdicts.includes(box.value);
    form.elements.section.value = asked.get("section") || "";
    if (form.elements.section.selectedIndex < 0) form.elements.section.value = "";
    form.elements.q.value = asked.get("q") || "";
    apply();
  };

  const changed = () => {
    apply();
    try { history.replaceState(null, "", address()); } catch { /* a page without an address of its own keeps none */ }
  };

  // Opens whatever hides the place that the address names, goes there, and lets the keyboard go on from there.
  const follow = () => {
    const hash = location.hash;
    if (hash.startsWith("#?")) {
      choose(hash.slice(2));
      document.getElementById("claims").scrollIntoView();
      return;
    }
    let name = hash.slice(1);
    try { name = decodeURIComponent(name); } catch { /* taken as it stands */ }
    let place = name && document.getElementById(name);
    if (!place) return;
    if (name === "claims" || place.closest("[hidden]")) choose("");
    unfold(place.matches(".claim") ? place.querySelector("details") : place);
    place = document.getElementById(name); // what was a line of the list is whole now
    unfold(place);
    place.scrollIntoView();
    if (place.tabIndex === -1 && !place.matches("a, button, input")) {
      if (!place.hasAttribute("tabindex")) place.setAttribute("tabindex", "-1");
      place.focus({ preventScroll: true });
    }
  };

  // A picture that is wider than its box begins with its top in view.
  for (const picture of document.querySelectorAll(".scroll > .tree")) {
    const top = picture.querySelector(".node").getBoundingClientRect();
    const box = picture.parentElement;
    box.scrollLeft += top.left + top.width / 2 - box.getBoundingClientRect().left - box.clientWidth / 2;
  }

  // What moves can be stopped.
  const motion = document.getElementById("motion");
  const pause = document.getElementById("pause");
  pause.addEventListener("click", () => {
    if (motion.animationsPaused()) motion.unpauseAnimations();
    else motion.pauseAnimations();
    pause.textContent = motion.animationsPaused() ? "Go on" : "Pause";
  });
  pause.hidden = false;

  form.hidden = false;
  form.addEventListener("submit", (event) => event.preventDefault());
  form.addEventListener("change", changed);
  form.elements.q.addEventListener("input", () => {
    clearTimeout(timer);
    timer = setTimeout(changed, 120);
  });
  form.addEventListener("reset", () => setTimeout(changed));
  addEventListener("hashchange", follow);
  // A link to where the address points already changes no address.
  document.addEventListener("click", (event) => {
    const link = event.target.closest && event.target.closest("a");
    const to = link && link.getAttribute("href");
    if (to && to === location.hash) follow();
  });

  // On paper, what is folded is opened where it is part of the argument; certificates stay in the store.
  const folded = [];
  addEventListener("beforeprint", () => {
    for (const box of document.querySelectorAll("details.in-print:not([open])")) {
      fill(box);
      box.open = true;
      folded.push(box);
    }
  });
  addEventListener("afterprint", () => {
    while (folded.length) folded.pop().open = false;
  });

  const start = () => {
    document.addEventListener("toggle", (event) => { if (event.target.open) fill(event.target); }, true);
    for (const box of document.querySelectorAll("details[open]")) fill(box);
    if (location.hash) follow();
  };
  unpacked().then(() => document.documentElement.classList.add("whole"), () => {}).then(start);
})();
