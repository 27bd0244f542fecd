// SPDX-License-Identifier: MIT
#include "verifier/report/html_parts.h"

namespace threefold::report {

// Pictures of one experiment share a cross hair; enlarged, they lie on one another and can be flipped (point at a name,
// keys 1 to 9, arrows, space), split, or blinked at 1.4 Hz, well below what is unsafe to look at; what was measured
// is drawn on them until it is switched off.
const std::string_view page_script = R"js(
(() => {
  'use strict';
  // What is folded away stays so on paper: opened, a run of many claims would fill hundreds of pages.
  const folds = [...document.querySelectorAll('details.fold')];
  const unfolded = document.querySelectorAll(folds.length ? '.why details' : 'details');
  let opened = [];
  addEventListener('beforeprint', () => { opened = [...unfolded].filter(d => !d.open); opened.forEach(d => { d.open = true; }); });
  addEventListener('afterprint', () => opened.forEach(d => { d.open = false; }));
  for (const button of document.querySelectorAll('[data-folds]'))
    button.addEventListener('click', () => folds.forEach(d => { d.open = button.dataset.folds === 'open'; }));
  document.querySelectorAll('.all-folds').forEach(p => { p.hidden = false; });

  for (const experiment of document.querySelectorAll('.experiment')) {
    experiment.addEventListener('pointermove', event => {
      const picture = event.target.closest('.picture');
      experiment.classList.toggle('pointed', Boolean(picture) && event.pointerType === 'mouse');
      if (!picture) return;
      const box = picture.getBoundingClientRect();
      experiment.style.setProperty('--x', 100 * (event.clientX - box.left) / box.width + '%');
      experiment.style.setProperty('--y', 100 * (event.clientY - box.top) / box.height + '%');
    });
    experiment.addEventListener('pointerleave', () => experiment.classList.remove('pointed'));
  }

  const viewer = document.getElementById('viewer');
  if (!viewer || !viewer.showModal) return;
  const find = selector => viewer.querySelector(selector);
  const tabs = find('.tabs'), stage = find('.stage'), under = find('.under'), over = find('.over'), says = find('.says'), range = find('input');
  const underMarks = find('.marks-under'), overMarks = find('.marks-over');
  let pictures = [], chosen = 0, other = 0, preview = null, timer = 0;

  const fit = () => {
    if (!viewer.open || !pictures.length) return;
    const image = pictures[chosen].image, ratio = image.naturalWidth / image.naturalHeight || 1;
    const free = stage.parentElement.clientHeight - find('.bar').offsetHeight - says.offsetHeight - range.offsetHeight - 24;
    const width = Math.max(64, Math.min(stage.parentElement.clientWidth - 16, free * ratio));
    stage.style.width = width + 'px';
    stage.style.height = width / ratio + 'px';
  };
  const lay = (place, picture) => place.replaceChildren(...(picture.marks ? [picture.marks.cloneNode(true)] : []));
  const draw = () => {
    const split = viewer.classList.contains('split'), shown = preview ?? chosen;
    under.src = pictures[shown].image.src;
    under.alt = pictures[shown].title;
    over.src = pictures[other].image.src;
    lay(underMarks, pictures[shown]);
    lay(overMarks, pictures[other]);
    [...tabs.children].forEach((tab, i) => tab.setAttribute('aria-pressed', String(i === shown)));
    says.textContent = pictures.length < 2 ? pictures[shown].title
      : split ? 'Left: ' + pictures[shown].title + '. Right: ' + pictures[other].title + '. Move the pointer to move the border.'
      : pictures[shown].title + '. Space or a press on the picture flips to ' + pictures[shown === other ? chosen : other].title + '.';
  };
  const choose = index => {
    if (index === chosen || !pictures[index]) return;
    other = chosen;
    chosen = index;
    draw();
  };
  const flip = () => { if (pictures.length > 1) choose(other); };
  const set = (mode, on) => {
    viewer.classList.toggle(mode, on);
    find('[data-mode=' + mode + ']').setAttribute('aria-pressed', String(on));
    clearInterval(timer);
    if (mode === 'blink' && on) timer = setInterval(flip, 350);
  };
  const toggle = mode => {
    const on = !viewer.classList.contains(mode) && pictures.length > 1;
    set('split', false);
    set('blink', false);
    if (on) set(mode, true);
    draw();
    fit();
  };
  const showMarks = on => {
    viewer.classList.toggle('unmarked', !on);
    find('[data-mode=marks]').setAttribute('aria-pressed', String(on));
  };
  const divide = share => {
    range.value = share;
    stage.style.setProperty('--split', share + '%');
  };
  const open = button => {
    const experiment = button.closest('.experiment');
    const buttons = [...experiment.querySelectorAll('.picture')];
    pictures = buttons.map(b => {
      const figure = b.closest('figure');
      return { image: b.firstElementChild, title: figure.querySelector('figcaption').textContent, marks: figure.querySelector('.marks') };
    });
    chosen = buttons.indexOf(button);
    other = pictures.length > 1 ? (chosen === 0 ? 1 : 0) : 0;
    preview = null;
    tabs.replaceChildren(...pictures.map((picture, i) => {
      const tab = document.createElement('button'), key = document.createElement('kbd');
      tab.type = 'button';
      key.textContent = i < 9 ? String(i + 1) : '';
      tab.append(picture.title + ' ', key);
      tab.addEventListener('click', () => { preview = null; choose(i); draw(); });
      tab.addEventListener('pointerenter', event => { if (event.pointerType === 'mouse') { preview = i; draw(); } });
      tab.addEventListener('pointerleave', () => { preview = null; draw(); });
      return tab;
    }));
    find('.modes').querySelectorAll('[data-mode=split], [data-mode=blink]').forEach(b => { b.hidden = pictures.length < 2; });
    find('[data-mode=marks]').hidden = !pictures.some(p => p.marks);
    set('split', false);
    set('blink', false);
    divide(50);
    viewer.showModal();
    tabs.children[chosen].focus();
    draw();
    fit();
  };

  document.addEventListener('click', event => {
    const button = event.target.closest('.picture');
    if (button) open(button);
  });
  viewer.addEventListener('close', () => { clearInterval(timer); pictures = []; });
  viewer.addEventListener('keydown', event => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const n = pictures.length, key = event.key.toLowerCase();
    if (key >= '1' && key <= '9' && key.length === 1) choose(Number(key) - 1);
    else if (event.target === range && key.startsWith('arrow')) return;
    else if (key === 'arrowright') choose((chosen + 1) % n);
    else if (key === 'arrowleft') choose((chosen + n - 1) % n);
    else if (key === ' ') flip();
    else if (key === 's') toggle('split');
    else if (key === 'b') toggle('blink');
    else if (key === 'm') showMarks(viewer.classList.contains('unmarked'));
    else return;
    event.preventDefault();
  });
  find('.modes').addEventListener('click', event => {
    const mode = event.target.closest('button')?.dataset.mode;
    if (mode === 'close') viewer.close();
    else if (mode === 'marks') showMarks(viewer.classList.contains('unmarked'));
    else if (mode) toggle(mode);
  });
  stage.addEventListener('pointermove', event => {
    const box = stage.getBoundingClientRect();
    divide(Math.min(100, Math.max(0, 100 * (event.clientX - box.left) / box.width)));
  });
  stage.addEventListener('click', () => { if (!viewer.classList.contains('split')) flip(); });
  range.addEventListener('input', () => divide(Number(range.value)));
  addEventListener('resize', fit);
})();
)js";

} // namespace threefold::report
